// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/random_signs.h>
#include <batten/fem/standard_error.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace batten {

namespace {

constexpr std::size_t probe_count = 64;
constexpr double accuracy = 1e-5;  // of the solves: far below what the probes or σ leave open

double mean_square_error(const FitProblem& problem, std::span<const double> coefficients, double degrees) {
  const auto n = static_cast<double>(problem.size());
  if (!(n - degrees > 1e-6 * n))
    throw InvalidInput("standard error: expected fewer effective degrees of freedom than points, found " +
                       std::to_string(degrees) + " for " + std::to_string(problem.size()) +
                       " points (use more smoothing)");
  double misfit = 0;
  const auto r = problem.residuals(coefficients);
  for (std::size_t i = 0; i < r.size(); ++i) misfit += problem.weight()[i] * r[i] * r[i];
  return misfit / (n - degrees);
}

}  // namespace

Uncertainty uncertainty(const FitProblem& problem, std::span<const double> coefficients, const FitOptions& options,
                        std::size_t exact_up_to) {
  const std::size_t n = problem.size();
  const auto& space = problem.hierarchy().finest().space;
  const TensorSum sampling({{1., space.y.samples(0), space.x.samples(0)}});
  const bool exact = n <= exact_up_to;
  const std::size_t probes = exact ? n : probe_count;
  IterationLimits limits = options.limits;
  limits.accuracy = std::max(accuracy, limits.accuracy);
  double trace = 0;
  std::vector<double> sum(sampling.output_size()), values(sampling.output_size()), c(problem.system().size()), v(n);
  for (std::size_t k = 0; k < probes; ++k) {
    if (exact) std::fill(v.begin(), v.end(), 0.);
    if (exact) v[k] = 1;
    if (!exact) v = random_signs(n, options.seed, k);
    for (std::size_t i = 0; i < n; ++i) v[i] /= std::sqrt(problem.weight()[i]);
    std::fill(c.begin(), c.end(), 0.);
    const auto b = problem.right_side(problem.weight(), v);
    solve(problem.system(), b, c, limits);
    for (std::size_t i = 0; i < c.size(); ++i) trace += b[i] * c[i];
    sampling.apply(c, values);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += values[i] * values[i];
    if (options.progress) options.progress("standard error", static_cast<double>(k) / static_cast<double>(probes));
  }
  const double share = exact ? 1 : 1. / static_cast<double>(probes);
  const double variance = mean_square_error(problem, coefficients, trace * share);
  for (double& s : sum) s = std::sqrt(variance * s * share);
  return {trace * share, std::move(sum)};
}

}  // namespace batten
