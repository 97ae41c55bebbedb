// SPDX-License-Identifier: MIT
#include <batten/flows/coupled_level.h>

#include <algorithm>
#include <utility>

namespace batten {
namespace {

const SplineSpace& space_of(const FitProblem& problem, int level) { return problem.hierarchy()[level].space; }

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

std::vector<double> restricted(const Hierarchy& h, int level, std::span<const double> r) {
  std::vector<double> fine(r.begin(), r.end()), coarse;
  for (int k = 0; k < level; ++k) {
    coarse.resize(h[k + 1].space.size());
    h.restrict_from(k, fine, coarse);
    std::swap(fine, coarse);
  }
  return fine;
}

std::vector<double> refined(const Hierarchy& h, int level, std::vector<double> coarse) {
  fill_images(h[level].space, coarse);
  std::vector<double> fine;
  for (int k = level - 1; k >= 0; --k) {
    fine.resize(h[k].space.size());
    h[k].refinement->apply(coarse, fine);
    std::swap(coarse, fine);
  }
  return coarse;
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

CoupledLevel::CoupledLevel(const CoupledParts& parts, int level, const Eigen::MatrixXd& unseen)
    : parts_(parts),
      level_(level),
      psi_(space_of(parts.stream, level)),
      phi_(space_of(parts.potential, level)),
      psi_data_(psi_, parts.stream.points(), true),
      phi_data_(phi_, parts.potential.points(), true),
      is_held_(determining(unseen, psi_, phi_)) {}

void CoupledLevel::set(double lambda, std::span<const double> weights) {
  std::vector<double> potential_weights(weights.begin(), weights.end());
  for (std::size_t i = 0; i < weights.size(); ++i) potential_weights[i] *= parts_.factor[i] * parts_.factor[i];
  psi_data_.set_weights(weights);
  phi_data_.set_weights(potential_weights);
  std::vector<Eigen::Triplet<double>> entries;
  add_part({psi_, parts_.stream.hierarchy()[level_].energy, psi_data_, lambda, 0}, entries);
  add_part({phi_, parts_.potential.hierarchy()[level_].energy, phi_data_, parts_.ratio * lambda, half()}, entries);
  add_cross(weights, entries);
  const auto n = static_cast<Eigen::Index>(2 * half());
  Eigen::SparseMatrix<double> lower(n, n);
  lower.setFromTriplets(entries.begin(), entries.end());
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
void CoupledLevel::add_cross(std::span<const double> weights, std::vector<Eigen::Triplet<double>>& entries) const {
  const int d = psi_.x.degree(), nx = psi_.x.size(), width = 2 * d + 1;
  const auto products = cross_products(weights);
  for (int j = 0; j < psi_.y.size(); ++j)
    for (int i = 0; i < nx; ++i)
      for (int dy = std::max(-d, -j); dy <= std::min(d, psi_.y.size() - 1 - j); ++dy)
        for (int dx = std::max(-d, -i); dx <= std::min(d, nx - 1 - i); ++dx) {
          const std::size_t column = psi_.original(i, j), row = half() + phi_.original(i + dx, j + dy);
          const auto at = static_cast<std::size_t>(((j * nx + i) * width + dy + d) * width + dx + d);
          if (products[at] != 0 && !is_held_[row] && !is_held_[column])
            entries.emplace_back(static_cast<int>(row), static_cast<int>(column), products[at]);
        }
}

/// [coefficient of ψ][dy + d][dx + d], image by image.
std::vector<double> CoupledLevel::cross_products(std::span<const double> weights) const {
  const int d = psi_.x.degree(), nx = psi_.x.size(), width = 2 * d + 1;
  std::vector<double> result(half() * static_cast<std::size_t>(width * width));
  const auto add_row = [&](const double* a, const PointRow& phi, int dy, double weight, double* out) {
    for (int p = 0; p <= d; ++p)
      for (int q = 0; q <= d; ++q)
        out[(p * width + dy + d) * width + q - p + d] += weight * a[p] * phi.x[static_cast<std::size_t>(q)];
  };
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const PointRow psi = psi_data_.row(i), phi = phi_data_.row(i);
    const double w = weights[i] * parts_.factor[i];
    for (int s = 0; s <= d; ++s)
      for (int t = 0; t <= d; ++t)
        add_row(psi.x.data(), phi, t - s, w * psi.y[static_cast<std::size_t>(s)] * phi.y[static_cast<std::size_t>(t)],
                result.data() + static_cast<std::ptrdiff_t>((psi.first_y + s) * nx + psi.first_x) * width * width);
  }
  return result;
}

std::vector<double> CoupledLevel::correction(std::span<const double> r) const {
  const Hierarchy &h = parts_.stream.hierarchy(), &g = parts_.potential.hierarchy();
  auto c = restricted(h, level_, r.first(r.size() / 2));
  const auto more = restricted(g, level_, r.last(r.size() / 2));
  c.insert(c.end(), more.begin(), more.end());
  for (std::size_t i = 0; i < c.size(); ++i)
    if (is_held_[i]) c[i] = 0;
  factorised_->solve(c);
  const auto middle = c.begin() + static_cast<std::ptrdiff_t>(half());
  auto result = refined(h, level_, {c.begin(), middle});
  const auto second = refined(g, level_, {middle, c.end()});
  result.insert(result.end(), second.begin(), second.end());
  return result;
}

int coupled_level(const CoupledParts& parts, double cells, std::size_t most) {
  const Hierarchy &h = parts.stream.hierarchy(), &g = parts.potential.hierarchy();
  int k = std::min(h.size(), g.size()) - 1;
  while (k > 0) {
    const SplineSpace& space = h[k].space;
    if (std::max(space.x.interval().cells(), space.y.interval().cells()) >= cells || h[k - 1].space.kept() > most)
      break;
    --k;
  }
  return k;
}

}  // namespace batten
