// SPDX-License-Identifier: MIT
#include <batten/fem/block_vectors.h>
#include <batten/fem/grid_energy.h>
#include <batten/fem/pair_weights.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace batten {

GridEnergy::GridEnergy(PenalisedProblem& problem, std::vector<double> fixed, std::vector<double> start)
    : problem_(problem), fixed_(std::move(fixed)), c_(std::move(start)), dc_(c_.size()) {
  fixed_.resize(problem.size());
}

double GridEnergy::energy_of(std::span<const double> c) const {
  std::vector<double> image(c.size());
  problem_.apply_energy(c, image);
  double sum = dot(c, image);
  const auto misfit = problem_.residuals(c);
  for (std::size_t i = 0; i < misfit.size(); ++i) sum += fixed_[i] * misfit[i] * misfit[i];
  return sum / 2;
}

std::vector<double> GridEnergy::rows_of(std::vector<double> numbers) const {
  for (std::size_t i = 0; i < factors_.size(); ++i) numbers[i] /= factors_[i];
  return numbers;
}

std::vector<double> GridEnergy::pull(std::span<const double> force) const {
  auto forces = problem_.residuals(c_);
  const auto own = rows_of({force.begin(), force.end()});
  for (std::size_t i = 0; i < forces.size(); ++i) forces[i] = fixed_[i] * forces[i] + own[i];
  const std::vector<double> ones(forces.size(), 1.);
  auto result = problem_.right_side(ones, forces);
  std::vector<double> image(c_.size());
  problem_.apply_energy(c_, image);
  combine(-1, image, 1, result);
  return result;
}

// The solver expects weights with a sum of about 1, as those of data have.
double GridEnergy::set(const RowWeights& weights, double stiffness) {
  constexpr double least_share = 1e-15;  // of a measurement without weight, which the multigrid does not know
  PairWeights w(weights.diagonal, weights.beside);
  if (!factors_.empty()) w = w.scaled(rows_of(std::vector<double>(factors_.size(), 1.)));
  for (std::size_t i = 0; i < w.size(); ++i) w.diagonal[i] += stiffness * fixed_[i];
  const double unit = std::accumulate(w.diagonal.begin(), w.diagonal.end(), 0.);
  for (double& v : w.diagonal) v = std::max(v / unit, least_share);
  for (double& v : w.beside) v /= unit;
  problem_.set(stiffness / unit, w.diagonal, w.beside);
  return unit;
}

double GridEnergy::solve(std::span<const double> b, std::span<double> c, double accuracy) {
  IterationLimits limits;
  limits.accuracy = accuracy;
  const auto result = problem_.solve(b, c, limits, 0);
  cycles_ += result.iterations + 1;
  return result.accuracy;
}

std::vector<double> GridEnergy::direction(const RowWeights& weights, std::span<const double> force, double accuracy) {
  const double unit = set(weights, 1);
  weights_ = weights;
  auto b = pull(force);
  for (double& v : b) v /= unit;
  solve(b, dc_, accuracy);
  return rows_of(problem_.values(dc_));
}

std::vector<double> GridEnergy::response(const RowWeights& weights, std::span<const double> force, double accuracy) {
  const double unit = set(weights, 1);
  const std::vector<double> scaled(force.size(), 1 / unit);
  std::vector<double> c(c_.size());
  solve(problem_.right_side(scaled, rows_of({force.begin(), force.end()})), c, accuracy);
  return rows_of(problem_.values(c));
}

void GridEnergy::advance(double step) {
  combine(step, dc_, 1, c_);
  std::fill(dc_.begin(), dc_.end(), 0.);
}

// The forces f' = f - W B d / stiffness with (stiffness Q + Bᵀ W B) d = stiffness (q - Q c + Bᵀ f) belong to c + d: Q
// (c
// + d) = q + Bᵀ f'. They differ from f by what is out of balance, and little else.
double GridEnergy::bound(std::span<double> force) {
  constexpr double stiffness = 100, accuracy = 1e-4;
  const double unit = set(weights_, stiffness);
  auto b = pull(force);
  for (double& v : b) v *= stiffness / unit;
  std::vector<double> d(c_.size());
  const double reached = solve(b, d, accuracy);
  const double left = reached * reached * dot(b, d) * unit / stiffness / 2;
  auto held = rows_of(problem_.values(d));
  PairWeights(weights_.diagonal, weights_.beside).multiply(held);
  combine(-1 / stiffness, held, 1, force);
  combine(1, c_, 1, d);
  return energy_of(d) - dot(force, rows_of(problem_.values(d))) - left;
}

}  // namespace batten
