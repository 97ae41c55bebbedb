// SPDX-License-Identifier: MIT
#include <batten/fem/near_interpolation.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

double largest(std::span<const double> values) {
  double result = 0;
  for (double v : values) result = std::max(result, std::abs(v));
  return result;
}

}  // namespace

ScaledFit interpolate(PenalisedProblem& problem, const FitOptions& options) {
  constexpr int most_steps = 12;
  constexpr double goal = 1e-10;
  ScaledFit fit{std::vector<double>(problem.unknowns()), interpolation_lambda, 0, 0};
  problem.set(fit.lambda);
  auto residual = problem.residuals(fit.coefficients);
  double before = largest(residual);
  std::vector<double> step(fit.coefficients.size());
  for (int k = 0; k < most_steps && before > goal; ++k) {
    // Data moved by the sum of residuals give the old solution plus the one for the last residual.
    std::fill(step.begin(), step.end(), 0.);
    const auto b = problem.right_side(problem.weight(), residual);
    const auto result = problem.solve(b, step, options.limits, 0);
    fit.iterations += result.iterations;
    fit.accuracy = std::max(fit.accuracy * before, result.accuracy);
    for (std::size_t i = 0; i < step.size(); ++i) fit.coefficients[i] += step[i];
    residual = problem.residuals(fit.coefficients);
    const double now = largest(residual);
    if (options.progress) options.progress("interpolate", std::min(1., std::log(now) / std::log(goal)));
    if (now > 0.9 * before) break;
    before = now;
  }
  return fit;
}

}  // namespace batten
