// SPDX-License-Identifier: MIT
#include <batten/bases/eigensystem.h>
#include <batten/fem/block_vectors.h>
#include <batten/flows/coupled_problem.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace batten {
namespace {

/// What a row measures besides the slope of ψ: in u = ψ_y + φ_x / c this factor of φ_x, in -c v = ψ_x - c φ_y of φ_y.
double factor_of(const FlowData& data, std::size_t row) {
  return data.rows.kind[row] == Measured::SlopeY ? 1 / data.stretch[row] : -data.stretch[row];
}

/// The slopes of φ in the rows of ψ.
FitData rows_of_potential(const FlowData& data) {
  FitData result = data.rows;
  for (std::size_t i = 0; i < result.size(); ++i) {
    Measured& kind = result.kind[i];
    kind = kind == Measured::SlopeY ? Measured::SlopeX : Measured::SlopeY;
    result.weight[i] *= factor_of(data, i) * factor_of(data, i);
  }
  return result;
}

constexpr double unseen_part = 1e-9;  // of what the data see best

std::vector<double> coefficients(const QuadraticFunction& q, const SplineSpace& space) {
  std::vector<double> c(space.size());
  q.add_to(space, c);
  for (int j = 0; j < space.y.size(); ++j)
    for (int i = 0; i < space.x.size(); ++i)
      if (space.is_removed(i, j)) c[static_cast<std::size_t>(j * space.x.size() + i)] = 0;
  fill_images(space, c);
  return c;
}

/// Σ_k c_k pairs_k
QuadraticPair combination(const std::vector<QuadraticPair>& pairs, const Eigen::VectorXd& c) {
  QuadraticPair result = pairs.front();
  result.psi.c = result.phi.c = {};
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (std::size_t i = 0; i < 6; ++i) {
      result.psi.c[i] += c[static_cast<Eigen::Index>(k)] * pairs[k].psi.c[i];
      result.phi.c[i] += c[static_cast<Eigen::Index>(k)] * pairs[k].phi.c[i];
    }
  return result;
}

}  // namespace

CoupledProblem::CoupledProblem(const FlowData& data, const Rectangle& region, const FitOptions& options,
                               const FlowOptions& flow)
    : data_(data),
      options_(options),
      flow_(flow),
      potential_rows_(rows_of_potential(data)),
      stream_(data.rows, region, options, side_conditions(flow.sides, {false, true})),
      potential_(potential_rows_, region, options, side_conditions(flow.sides, {true, true})) {
  for (const std::size_t row : stream_.order()) factor_.push_back(factor_of(data, row));
  cycle_.emplace(parts(), [this](int level) { return unseen_on(level); });
  find_unseen();
}

void CoupledProblem::find_unseen() {
  const auto pairs =
      flow_.geographic ? pairs_without_energy(region(), flow_.sides) : unseen_pairs(region(), flow_.sides);
  unseen_ = pairs;
  null_space_ = unseen_on(0);
  if (pairs.empty()) return;
  Eigen::MatrixXd combine = orthonormalisation(tall_products(null_space_, null_space_));
  if (flow_.geographic) {
    Eigen::MatrixXd seen(static_cast<Eigen::Index>(size()), combine.cols());
    for (Eigen::Index k = 0; k < combine.cols(); ++k) {
      const Eigen::VectorXd column = null_space_ * combine.col(k);
      const auto measured = values({column.data(), unknowns()});
      for (std::size_t i = 0; i < size(); ++i)
        seen(static_cast<Eigen::Index>(i), k) = std::sqrt(weight()[i]) * measured[i];
    }
    const SymmetricEigensystem parts = symmetric_eigensystem(tall_products(seen, seen));
    const double largest = parts.values.maxCoeff();
    const auto unseen = (parts.values.array() <= unseen_part * largest).count();  // the first ones
    combine = (combine * parts.vectors.leftCols(unseen)).eval();
  }
  unseen_.clear();
  for (const Eigen::VectorXd c : combine.colwise()) unseen_.push_back(combination(pairs, c));
  null_space_ = unseen_on(0);
}

Eigen::MatrixXd CoupledProblem::unseen_on(int level) const {
  const SplineSpace &psi = stream_.hierarchy()[level].space, &phi = potential_.hierarchy()[level].space;
  Eigen::MatrixXd result(static_cast<Eigen::Index>(2 * psi.size()), static_cast<Eigen::Index>(unseen_.size()));
  for (std::size_t k = 0; k < unseen_.size(); ++k) {
    auto column = coefficients(unseen_[k].psi, psi);
    const auto more = coefficients(unseen_[k].phi, phi);
    column.insert(column.end(), more.begin(), more.end());
    result.col(static_cast<Eigen::Index>(k)) = Eigen::Map<Eigen::VectorXd>(column.data(), result.rows());
  }
  return result;
}

void CoupledProblem::set(double lambda, std::span<const double> weights, std::span<const double> beside) {
  PairWeights w(weights, beside);
  if (lambda == lambda_ && w == weights_) return;
  lambda_ = 0;  // until all is set: a factorisation may fail
  const PairWeights more = w.scaled(factor_);
  stream_.set(lambda, w.diagonal, w.beside);
  potential_.set(flow_.ratio * lambda, more.diagonal, more.beside);
  cycle_->set(lambda, w);
  lambda_ = lambda;
  weights_ = std::move(w);
}

double CoupledProblem::apply(std::span<const double> c, std::span<double> out) const {
  stream_.apply(psi_of(c), psi_of(out));
  potential_.apply(phi_of(c), phi_of(out));
  cycle_->data().add_cross(1, c, out);
  return dot(c, out);
}

void CoupledProblem::apply_energy(std::span<const double> c, std::span<double> out) const {
  stream_.apply_energy(psi_of(c), psi_of(out));
  potential_.apply_energy(phi_of(c), phi_of(out));
  for (double& v : phi_of(out)) v *= flow_.ratio;
}

void CoupledProblem::precondition(std::span<const double> residual, std::vector<double>& out) const {
  // What the data hardly see is no exact element of the null space, and the residual has a part of it.
  Eigen::MatrixXd seen = Eigen::Map<const Eigen::VectorXd>(residual.data(), static_cast<Eigen::Index>(residual.size()));
  if (flow_.geographic) subtract_product(seen, null_space_, tall_products(null_space_, seen));
  cycle_->apply({seen.data(), residual.size()}, out);
  if (unseen_.empty()) return;
  Eigen::Map<Eigen::MatrixXd> result(out.data(), static_cast<Eigen::Index>(out.size()), 1);
  subtract_product(result, null_space_, tall_products(null_space_, result));
}

ExtraFunction CoupledProblem::extra_function(const SideFunction& function, bool is_potential) const {
  ExtraFunction result = batten::extra_function(function, is_potential ? potential_ : stream_);
  const auto in_half = [&](std::vector<double>& v) { v.insert(is_potential ? v.begin() : v.end(), v.size(), 0.); };
  in_half(result.coefficients);
  in_half(result.energy);
  if (!is_potential) return result;
  for (double& v : result.energy) v *= flow_.ratio;
  result.own_energy *= flow_.ratio;
  for (std::size_t i = 0; i < size(); ++i) result.values[i] *= factor_[i];
  return result;
}

std::vector<double> CoupledProblem::right_side(std::span<const double> weights, std::span<const double> values) const {
  std::vector<double> factored(values.begin(), values.end());
  for (std::size_t i = 0; i < size(); ++i) factored[i] *= factor_[i];
  auto b = stream_.right_side(weights, values);
  const auto more = potential_.right_side(weights, factored);
  b.insert(b.end(), more.begin(), more.end());
  return b;
}

std::vector<double> CoupledProblem::values(std::span<const double> c) const {
  auto result = stream_.values(psi_of(c));
  const auto more = potential_.values(phi_of(c));
  for (std::size_t i = 0; i < result.size(); ++i) result[i] += factor_[i] * more[i];
  return result;
}

std::vector<double> CoupledProblem::whole(std::span<const double> c) const {
  auto result = stream_.whole(psi_of(c));
  const auto more = potential_.whole(phi_of(c));
  result.insert(result.end(), more.begin(), more.end());
  return result;
}

std::unique_ptr<PenalisedProblem> CoupledProblem::on(const Rectangle& grid) const {
  return std::make_unique<CoupledProblem>(data_, grid, options_, flow_);
}

}  // namespace batten
