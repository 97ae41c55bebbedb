// SPDX-License-Identifier: MIT
#include <batten/bases/stream_function.h>

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

// With K the differences of second order of a path of n + 1 points, natural at its ends, and W = diag(1/2, 1 ... 1,
// 1/2), the normal equations are (Wx ⊗ Ky + Kx ⊗ Wy) ψ = F. cos(πik/n) is the eigenvector of W⁻¹K for 4 sin²(πk/2n),
// and the cosine transform T f_k = f_0 + (-1)^k f_n + 2 Σ f_i cos(πik/n) brings W⁻¹K to its diagonal; T² = 2n.

namespace batten {
namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

/// Σ_i f_i e^(-2πi ik/n) by fast transforms for every n: those of Eigen take n p steps for a prime factor p. Where it
/// is large, ik = (i² + k² - (k-i)²) / 2 makes the sum a convolution, for which the length is free [Bluestein 1970].
class FourierSums {
public:
  explicit FourierSums(int n) : values(static_cast<std::size_t>(n)), is_direct_(!has_large_factor(n)) {
    if (is_direct_) return;
    std::size_t length = 1;
    while (length < 2 * values.size()) length *= 2;
    padded_.resize(length);
    std::vector<Complex> kernel(length);
    for (std::int64_t i = 0; i < n; ++i) {
      const Complex turn = std::polar(1., -pi * static_cast<double>(i * i % (2 * n)) / n);
      turns_.push_back(turn);
      const auto at = static_cast<std::size_t>(i);
      kernel[at] = kernel[at == 0 ? 0 : length - at] = std::conj(turn);
    }
    fft_.fwd(kernel_, kernel);
  }

  /// Replaces the values by their sums.
  void transform() {
    if (is_direct_) {
      fft_.fwd(sums_, values);
      values.swap(sums_);
      return;
    }
    std::fill(padded_.begin(), padded_.end(), Complex(0));
    for (std::size_t i = 0; i < values.size(); ++i) padded_[i] = values[i] * turns_[i];
    fft_.fwd(sums_, padded_);
    for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] *= kernel_[i];
    fft_.inv(padded_, sums_);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = padded_[k] * turns_[k];
  }

  std::vector<Complex> values;

private:
  static bool has_large_factor(int n) {
    constexpr int largest = 13;
    for (int p = 2; p <= largest; ++p)
      while (n % p == 0) n /= p;
    return n > 1;
  }

  bool is_direct_;
  Eigen::FFT<double> fft_;
  std::vector<Complex> turns_, kernel_, padded_, sums_;
};

/// T of every column. The sums of real columns are real, so that two are transformed as one of complex numbers.
Eigen::MatrixXd cosine_sums(Eigen::MatrixXd f) {
  const Eigen::Index n = f.rows() - 1;
#pragma omp parallel
  {
    FourierSums mirrored(static_cast<int>(2 * n));
#pragma omp for schedule(static)
    for (Eigen::Index j = 0; j < f.cols(); j += 2) {
      const Eigen::Index next = std::min(j + 1, f.cols() - 1);
      for (Eigen::Index i = 0; i < 2 * n; ++i) {
        const Eigen::Index from = std::min(i, 2 * n - i);
        mirrored.values[static_cast<std::size_t>(i)] = {f(from, j), f(from, next)};
      }
      mirrored.transform();
      for (Eigen::Index k = 0; k <= n; ++k) {
        f(k, next) = mirrored.values[static_cast<std::size_t>(k)].imag();
        f(k, j) = mirrored.values[static_cast<std::size_t>(k)].real();
      }
    }
  }
  return f;
}

double eigenvalue(Eigen::Index k, Eigen::Index n) {
  const double sine = std::sin(pi * static_cast<double>(k) / (2. * static_cast<double>(n)));
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
