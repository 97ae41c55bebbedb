// SPDX-License-Identifier: MIT
#include <batten/flows/coupled_level.h>

#include <algorithm>
#include <utility>

namespace batten {
namespace {

// Of the diagonal: what rounding leaves of a matrix in which λ is small. On the sphere there are pairs that neither the
// data nor the energy see more than that.
constexpr double unseen_by_rounding = 1e-13;

/// One coefficient for each column, so that what the columns combine to is determined by those: Gaussian elimination.
std::vector<bool> determining(Eigen::MatrixXd columns, const SplineSpace& psi, const SplineSpace& phi) {
  std::vector<bool> chosen(static_cast<std::size_t>(columns.rows()));
  for (Eigen::Index row = 0; row < columns.rows(); ++row) {
    const SplineSpace& space = row < columns.rows() / 2 ? psi : phi;
    const int k = static_cast<int>(row % (columns.rows() / 2)), nx = space.x.size();
    if (space.is_removed(k % nx, k / nx)) columns.row(row).setZero();  // images are no coefficients of their own
  }
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    Eigen::Index row = 0, column = 0;
    columns.rightCols(columns.cols() - k).cwiseAbs().maxCoeff(&row, &column);
    columns.col(k).swap(columns.col(k + column));
    chosen[static_cast<std::size_t>(row)] = true;
    for (Eigen::Index l = k + 1; l < columns.cols(); ++l)
      columns.col(l) -= columns(row, l) / columns(row, k) * columns.col(k);
  }
  return chosen;
}

}  // namespace

/// One of the two.
struct CoupledLevel::Part {
  const SplineSpace& space;
  const Operator& energy;
  const DataTerm& data;
  double lambda;
  std::size_t offset;  // of its coefficients
};

CoupledLevel::CoupledLevel(const CoupledParts& parts, int level, const CoupledData& data, double lambda,
                           const Eigen::MatrixXd& unseen)
    : psi_(parts.psi(level).space),
      phi_(parts.phi(level).space),
      data_(data),
      is_held_(determining(unseen, psi_, phi_)) {
  std::vector<Eigen::Triplet<double>> entries;
  add_part({psi_, parts.psi(level).energy, data_.psi(), lambda, 0}, entries);
  add_part({phi_, parts.phi(level).energy, data_.phi(), parts.ratio * lambda, half()}, entries);
  add_cross(entries);
  const auto n = static_cast<Eigen::Index>(size());
  Eigen::SparseMatrix<double> lower(n, n);
  lower.setFromTriplets(entries.begin(), entries.end());
  lower.diagonal() *= 1 + unseen_by_rounding;
  factorised_.emplace(lower);
}

/// The lower triangle of one diagonal block, entries of images at their originals.
void CoupledLevel::add_part(const Part& part, std::vector<Eigen::Triplet<double>>& entries) const {
  const int d = part.space.x.degree(), nx = part.space.x.size(), ny = part.space.y.size();
  const auto add = [&](std::size_t a, std::size_t b, double value) {
    const auto [column, row] = std::minmax({a + part.offset, b + part.offset});
    if (column == row || (!is_held_[row] && !is_held_[column]))
      entries.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
  };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const auto own = static_cast<std::size_t>(j * nx + i);
      if (part.space.is_removed(i, j)) add(own, own, 1);
      for (int dy = 0; dy <= std::min(d, ny - 1 - j); ++dy)
        for (int dx = dy == 0 ? 0 : std::max(-d, -i); dx <= std::min(d, nx - 1 - i); ++dx)
          add(part.space.original(i, j), part.space.original(i + dx, j + dy),
              part.lambda * part.energy.entry(i, j, i + dx, j + dy) + part.data.stencil().entry(i, j, dx, dy));
    }
}

/// Σ_i w_i factor_i a_i b_i^T of the rows of φ and of ψ.
void CoupledLevel::add_cross(std::vector<Eigen::Triplet<double>>& entries) const {
  const int d = psi_.x.degree(), nx = psi_.x.size(), ny = psi_.y.size();
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      for (int dy = std::max(-d, -j); dy <= std::min(d, ny - 1 - j); ++dy)
        for (int dx = std::max(-d, -i); dx <= std::min(d, nx - 1 - i); ++dx) {
          const std::size_t column = psi_.original(i, j), row = half() + phi_.original(i + dx, j + dy);
          const double value = data_.cross().entry(i, j, dx, dy);
          if (value != 0 && !is_held_[row] && !is_held_[column])
            entries.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
        }
}

void CoupledLevel::solve(std::span<double> b) const {
  for (std::size_t i = 0; i < b.size(); ++i)
    if (is_held_[i]) b[i] = 0;
  factorised_->solve(b);
  fill_images(psi_, psi_of(b));
  fill_images(phi_, phi_of(b));
}

}  // namespace batten
