// SPDX-License-Identifier: MIT
#include <batten/fem/block_vectors.h>
#include <batten/fem/dense_energy.h>
#include <batten/fem/elastic_energy.h>

#include <cmath>
#include <utility>

namespace batten {
namespace {

constexpr double border_accuracy = 1e-6;  // of A^-1 Bᵀ W growth: what it leaves does not shrink with the steps

}  // namespace

ElasticEnergy::ElasticEnergy(GridEnergy& energy, std::vector<Row> rows, double cost, double start)
    : energy_(energy), rows_(std::move(rows)), cost_(cost), theta_(start) {}

std::vector<double> ElasticEnergy::seen(std::span<const double> measurements, double theta) const {
  std::vector<double> result;
  result.reserve(rows_.size());
  for (const Row& row : rows_) {
    const double own = row.measurement < 0 ? 0 : measurements[static_cast<std::size_t>(row.measurement)];
    result.push_back(own + row.growth * theta);
  }
  return result;
}

std::vector<double> ElasticEnergy::gathered(std::span<const double> force) const {
  std::vector<double> result(energy_.rows());
  for (std::size_t r = 0; r < rows_.size(); ++r)
    if (rows_[r].measurement >= 0) result[static_cast<std::size_t>(rows_[r].measurement)] += force[r];
  return result;
}

/// Weights of the measurements, and what θ adds.
void ElasticEnergy::set(const RowWeights& weights) {
  if (weights.diagonal == weights_.diagonal && weights.beside == weights_.beside) return;
  weights_ = weights;
  Eigen::VectorXd growth(static_cast<Eigen::Index>(rows_.size()));
  for (std::size_t r = 0; r < rows_.size(); ++r) growth[static_cast<Eigen::Index>(r)] = rows_[r].growth;
  const Eigen::VectorXd pull = weighted(weights, growth);
  stiffness_ = growth.dot(pull);
  pull_ = gathered({pull.data(), rows_.size()});
  inner_ = {1, gathered(weights.diagonal), {}};
  const auto together = static_cast<std::size_t>(weights.together);
  if (together == 3) {  // θ, u, v
    inner_.together = 2;
    for (std::size_t pair = 2; pair < weights.beside.size(); pair += 3) inner_.beside.push_back(weights.beside[pair]);
  }
  border_ = energy_.response(inner_, pull_, border_accuracy);
}

// With h and g the directions of the forces and of W growth alone, dc = h - dθ g, and dθ balances what is left of the
// cost.
std::vector<double> ElasticEnergy::direction(const RowWeights& weights, std::span<const double> force,
                                             double accuracy) {
  set(weights);
  auto own = gathered(force);
  const auto h = energy_.direction(inner_, own, accuracy);
  double rest = -cost_;
  for (std::size_t r = 0; r < rows_.size(); ++r) rest += rows_[r].growth * force[r];
  theta_change_ = (rest - dot(pull_, h)) / (stiffness_ - dot(pull_, border_));
  combine(-theta_change_, pull_, 1, own);
  return seen(energy_.direction(inner_, own, accuracy), theta_change_);
}

void ElasticEnergy::advance(double step) {
  energy_.advance(step);
  theta_ += step * theta_change_;
}

double ElasticEnergy::spread(std::span<const double> own, std::span<double> force) const {
  double spread = 0, square = 0;
  for (std::size_t r = rows_.size(); r-- > 0;) {
    const Row& row = rows_[r];
    if (row.measurement < 0) {  // of a cone, whose point comes behind
      force[r] = std::sqrt(square);
      square = 0;
    } else {
      const double f = own[static_cast<std::size_t>(row.measurement)];
      force[r] = row.growth * f >= 0 ? f : 0;
      square += f * f;
    }
    spread += row.growth * force[r];
  }
  return spread;
}

// Forces in balance, scaled so that growth · f is the cost: then θ has no part in the minimum, and J's is of the second
// order in f.
double ElasticEnergy::bound(std::span<double> force) {
  auto own = gathered(force);
  const double least = energy_.bound(own);
  const double scale = cost_ / spread(own, force);
  for (double& f : force) f *= scale;
  return scale * scale * least;
}

}  // namespace batten
