// SPDX-License-Identifier: MIT
#include <batten/bases/stream_function.h>

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

// With K the differences of second order of a path of n + 1 points, natural at its ends, and W = diag(1/2, 1 ... 1,
// 1/2), the normal equations are (Wx ⊗ Ky + Kx ⊗ Wy) ψ = F. cos(πik/n) is the eigenvector of W⁻¹K for 4 sin²(πk/2n),
// and the cosine transform T f_k = f_0 + (-1)^k f_n + 2 Σ f_i cos(πik/n) brings W⁻¹K to its diagonal; T² = 2n.

namespace batten {
namespace {

/// T of every column.
Eigen::MatrixXd cosine_sums(Eigen::MatrixXd f) {
  const Eigen::Index n = f.rows() - 1;
#pragma omp parallel
  {
    Eigen::FFT<double> fft;
    fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
    std::vector<double> mirrored(static_cast<std::size_t>(2 * n));
    std::vector<std::complex<double>> sums;
#pragma omp for schedule(static)
    for (Eigen::Index j = 0; j < f.cols(); ++j) {
      for (Eigen::Index i = 0; i < 2 * n; ++i) mirrored[static_cast<std::size_t>(i)] = f(std::min(i, 2 * n - i), j);
      fft.fwd(sums, mirrored);
      for (Eigen::Index k = 0; k <= n; ++k) f(k, j) = sums[static_cast<std::size_t>(k)].real();
    }
  }
  return f;
}

double eigenvalue(Eigen::Index k, Eigen::Index n) {
  const double sine = std::sin(std::numbers::pi * static_cast<double>(k) / (2. * static_cast<double>(n)));
  return 4 * sine * sine;
}

/// Wx⁻¹ Wy⁻¹ F: - spacing² rotation inside.
Eigen::MatrixXd right_side(const StaggeredField& field) {
  const Eigen::Index nx = field.cells_x(), ny = field.cells_y();
  Eigen::MatrixXd along_y = Eigen::MatrixXd::Zero(nx + 1, ny + 1), along_x = along_y;
  along_y.rightCols(ny) += field.u;
  along_y.leftCols(ny) -= field.u;
  along_x.topRows(nx) += field.v;
  along_x.bottomRows(nx) -= field.v;
  for (Eigen::Index j : {Eigen::Index{0}, ny}) along_y.col(j) *= 2;
  for (Eigen::Index i : {Eigen::Index{0}, nx}) along_x.row(i) *= 2;
  return field.spacing * (along_x + along_y);
}

}  // namespace

ControlGrid stream_function(const StaggeredField& field) {
  require_field("stream_function", field);
  const Eigen::Index nx = field.cells_x(), ny = field.cells_y();
  Eigen::MatrixXd sums = cosine_sums(cosine_sums(right_side(field)).transpose());
  for (Eigen::Index k = 0; k <= nx; ++k)
    for (Eigen::Index l = 0; l <= ny; ++l)
      sums(l, k) /= 4. * static_cast<double>(nx * ny) * (eigenvalue(k, nx) + eigenvalue(l, ny));
  sums(0, 0) = 0;  // constants are not determined
  Eigen::MatrixXd psi = cosine_sums(cosine_sums(std::move(sums)).transpose());
  psi.array() -= double{psi(0, 0)};  // a copy
  return {.components = {std::move(psi)}, .start = field.start, .spacing = {field.spacing, field.spacing}};
}

}  // namespace batten
