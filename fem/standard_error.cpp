// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/random_signs.h>
#include <batten/fem/standard_error.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace batten {

std::vector<double> standard_error(const FitProblem& problem, std::span<const double> coefficients, double degrees,
                                   const FitOptions& options) {
  const std::size_t n = problem.size();
  const double free = static_cast<double>(n) - degrees;
  if (!(free > 1e-6 * static_cast<double>(n)))
    throw InvalidInput("standard_error: expected fewer effective degrees of freedom than points, found " +
                       std::to_string(degrees) + " for " + std::to_string(n) + " points (use more smoothing)");
  double misfit = 0;
  const auto r = problem.residuals(coefficients);
  for (std::size_t i = 0; i < n; ++i) misfit += problem.weight()[i] * r[i] * r[i];
  const double variance = misfit / free;

  const auto& space = problem.hierarchy().finest().space;
  const TensorSum sampling({{1., space.y.samples(0), space.x.samples(0)}});
  const bool exact = n <= most_exact_points;
  const std::size_t probes = exact ? n : 64;
  IterationLimits limits = options.limits;
  limits.accuracy = std::max(1e-5, limits.accuracy);
  std::vector<double> sum(sampling.output_size()), values(sampling.output_size()), c(problem.system().size()), v(n);
  for (std::size_t k = 0; k < probes; ++k) {
    if (exact) std::fill(v.begin(), v.end(), 0.);
    if (exact) v[k] = 1;
    if (!exact) v = random_signs(n, options.seed, k);
    for (std::size_t i = 0; i < n; ++i) v[i] /= std::sqrt(problem.weight()[i]);
    std::fill(c.begin(), c.end(), 0.);
    solve(problem.system(), problem.right_side(problem.weight(), v), c, limits);
    sampling.apply(c, values);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += values[i] * values[i];
    if (options.progress) options.progress("standard error", static_cast<double>(k) / static_cast<double>(probes));
  }
  for (double& s : sum) s = std::sqrt(variance * s / (exact ? 1. : static_cast<double>(probes)));
  return sum;
}

}  // namespace batten
