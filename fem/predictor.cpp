// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/predictor.h>

#include <string>

namespace batten {

using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

Predictor::Predictor(const std::vector<SplineLevel>& levels, const Options& options) : levels_(levels) {
  if (levels.empty()) throw InvalidInput("Predictor: expected at least one level, found none");
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
    const SplineLevel &coarse = levels[k], &fine = levels[k + 1];
    auto M = measurement_matrix(coarse, fine, options.kind).M;
    const bool exact = options.layers == 0;
    Step step{coarse.refinement(fine),
              M,
              exact ? std::variant<LeastEnergy, LocalScheme>(LeastEnergy(fine.energy(), M))
                    : std::variant<LeastEnergy, LocalScheme>(LocalScheme(coarse, fine, options.kind, options.layers)),
              {},
              {}};
    if (options.smoothing) {
      step.E = fine.energy();
      step.variables = free_coefficients(M);
    }
    steps_.push_back(std::move(step));
  }
}

VectorXd Predictor::predict(int k, const VectorXd& q) const {
  const Step& step = steps_[static_cast<std::size_t>(k)];
  const VectorXd m = step.M * (step.R * q);
  VectorXd result = std::visit([&](const auto& scheme) -> VectorXd { return scheme.apply(m); }, step.scheme);
  if (step.E.rows() > 0) smoothing_sweep(step.E, step.variables, result);
  return result;
}

Predictor::Prediction Predictor::run(const VectorXd& q0) const {
  if (q0.size() != levels_.front().size())
    throw InvalidInput("Predictor::run: expected " + std::to_string(levels_.front().size()) + " coefficients, found " +
                       std::to_string(q0.size()));
  Prediction result{{q0}, {levels_.front().energy_of(q0)}};
  for (int k = 0; k < steps(); ++k) {
    result.coefficients.push_back(predict(k, result.coefficients.back()));
    result.energies.push_back(levels_[static_cast<std::size_t>(k + 1)].energy_of(result.coefficients.back()));
  }
  return result;
}

void smoothing_sweep(const Sparse& E, const FreeCoefficients& variables, VectorXd& q) {
  const Sparse& Z = variables.Z;
  const auto improve = [&](Eigen::Index f) {
    double slope = 0, curvature = 0;
    for (Sparse::InnerIterator z(Z, f); z; ++z) {
      for (Sparse::InnerIterator e(E, z.row()); e; ++e) slope += z.value() * e.value() * q[e.row()];
      for (Sparse::InnerIterator y(Z, f); y; ++y) curvature += z.value() * E.coeff(y.row(), z.row()) * y.value();
    }
    for (Sparse::InnerIterator z(Z, f); z; ++z) q[z.row()] -= slope / curvature * z.value();
  };
  for (Eigen::Index f = 0; f < Z.cols(); ++f) improve(f);
  for (Eigen::Index f = Z.cols(); f-- > 0;) improve(f);
}

}  // namespace batten
