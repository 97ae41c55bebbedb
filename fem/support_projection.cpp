// SPDX-License-Identifier: MIT
#include <batten/fem/support_projection.h>

namespace batten {
namespace {

using Vector = Eigen::VectorXd;

Eigen::Map<const Vector> view(std::span<const double> v) { return {v.data(), static_cast<Eigen::Index>(v.size())}; }
Eigen::Map<Vector> view(std::span<double> v) { return {v.data(), static_cast<Eigen::Index>(v.size())}; }

/// Adds the rows of images.
Eigen::SparseMatrix<double> with_images(const SplineSpace& space, const Eigen::SparseMatrix<double>& originals) {
  if (!space.is_periodic()) return originals;
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < space.y.size(); ++j)
    for (int i = 0; i < space.x.size(); ++i)
      entries.emplace_back(j * space.x.size() + i, static_cast<int>(space.original(i, j)), 1.);
  Eigen::SparseMatrix<double> repeat(originals.rows(), originals.rows());
  repeat.setFromTriplets(entries.begin(), entries.end());
  return repeat * originals;
}

}  // namespace

SupportProjection::SupportProjection(const BoundarySystem& system) {
  const auto& points = system.multigrid().data();
  if (points.size() == 0) return;
  constexpr double regularisation = 1e-12;  // points closer to each other than a cell may ask the same
  Vector inverse = view(system.hierarchy().finest().energy.diagonal());
  inverse = inverse.unaryExpr([](double d) { return d > 0 ? 1 / d : 0.; });
  values_ = points.columns();
  answers_ = with_images(system.space(), inverse.asDiagonal() * values_);
  Eigen::SparseMatrix<double> compliance = values_.transpose() * answers_;
  for (Eigen::Index i = 0; i < compliance.rows(); ++i) compliance.coeffRef(i, i) *= 1 + regularisation;
  factor_.emplace(Eigen::SparseMatrix<double>(compliance.triangularView<Eigen::Lower>()));
}

void SupportProjection::project(std::span<double> v) const {
  if (is_identity()) return;
  Vector values = values_.transpose() * view(v);
  factor_->solve({values.data(), static_cast<std::size_t>(values.size())});
  view(v).noalias() -= answers_ * values;
}

void SupportProjection::project_transposed(std::span<double> r) const {
  if (is_identity()) return;
  Vector values = answers_.transpose() * view(r);
  factor_->solve({values.data(), static_cast<std::size_t>(values.size())});
  view(r).noalias() -= values_ * values;
}

std::vector<double> SupportProjection::lifting(std::span<const double> values) const {
  std::vector<double> result(static_cast<std::size_t>(values_.rows()));
  if (is_identity()) return result;
  Vector forces = view(values);
  factor_->solve({forces.data(), static_cast<std::size_t>(forces.size())});
  view(std::span<double>(result)).noalias() += answers_ * forces;
  return result;
}

}  // namespace batten
