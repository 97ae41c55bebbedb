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

namespace {

double largest_share(std::span<const double> values, std::span<const double> units) {
  double result = 0;
  for (std::size_t i = 0; i < values.size(); ++i) result = std::max(result, std::abs(values[i]) / units[i]);
  return result;
}

/// One problem of the method of multipliers: minimise λ E(p) + Σ w_i dist(p(x_i) + u_i, [z_i - t_i, z_i + t_i])².
class BoxProblem {
public:
  BoxProblem(PenalisedProblem& problem, std::span<const double> tolerances, const FitOptions& options)
      : problem_(problem),
        tolerances_(tolerances.begin(), tolerances.end()),
        options_(options),
        multiplier_(problem.size()),
        active_(problem.size()) {}

  /// Distance vector of p + u from the boxes, positive above.
  std::vector<double> excess(std::span<const double> c) const {
    auto e = problem_.residuals(c);  // z - p
    for (std::size_t i = 0; i < e.size(); ++i) {
      const double v = multiplier_[i] - e[i];
      e[i] = v - std::clamp(v, -inside * tolerances_[i], inside * tolerances_[i]);
    }
    return e;
  }

  /// Active sets: points outside their box are pulled to its near side, the others are held by a vanishing weight where
  /// they are.
  void solve_active_sets(ScaledFit& fit) {
    constexpr int most_sets = 40;
    std::vector<double> weight(problem_.size()), target(problem_.size());
    for (int k = 0; k < most_sets; ++k) {
      const auto e = excess(fit.coefficients);
      bool changed = k == 0;
      const auto r = problem_.residuals(fit.coefficients);
      for (std::size_t i = 0; i < e.size(); ++i) {
        const signed char side = e[i] > 0 ? 1 : e[i] < 0 ? -1 : 0;
        changed = changed || side != active_[i];
        active_[i] = side;
        weight[i] = problem_.weight()[i] * (side != 0 ? 1 : free_weight);
        // relative to the present p: step to the box, or stay
        target[i] = side != 0 ? -e[i] : 0;
      }
      if (!changed) return;
      step(weight, target, fit);
    }
  }

  void update_multipliers(std::span<const double> c) { multiplier_ = excess(c); }

  /// Largest |p(x_i) - z_i| in units of the tolerance of its point.
  double worst(std::span<const double> c) const { return largest_share(problem_.residuals(c), tolerances_); }

private:
  static constexpr double free_weight = 1e-9;
  static constexpr double inside = 1 - 1e-7;  // the margin is for what the multipliers leave

  /// c += minimiser of λ E(c + s) + Σ weight (s(x_i) - target_i)²
  void step(std::span<const double> weight, std::span<const double> target, ScaledFit& fit) {
    problem_.set(interpolation_lambda, weight);
    auto b = problem_.right_side(weight, target);
    std::vector<double> energy(b.size()), s(b.size());
    problem_.apply_energy(fit.coefficients, energy);
    for (std::size_t i = 0; i < b.size(); ++i) b[i] -= interpolation_lambda * energy[i];
    const auto result = problem_.solve(b, s, options_.limits, 0);
    fit.iterations += result.iterations;
    fit.accuracy = result.accuracy;
    for (std::size_t i = 0; i < s.size(); ++i) fit.coefficients[i] += s[i];
  }

  PenalisedProblem& problem_;
  std::vector<double> tolerances_;
  const FitOptions& options_;
  std::vector<double> multiplier_;
  std::vector<signed char> active_;
};

}  // namespace

ScaledFit interpolate_within(PenalisedProblem& problem, std::span<const double> tolerances, const FitOptions& options) {
  constexpr int most_steps = 12;
  ScaledFit fit{std::vector<double>(problem.unknowns()), interpolation_lambda, 0, 0};
  if (largest_share(problem.value(), tolerances) <= 1) return fit;  // the null element will do and has no energy
  BoxProblem box(problem, tolerances, options);
  double before = INFINITY;
  for (int k = 0; k < most_steps; ++k) {
    box.solve_active_sets(fit);
    const double now = box.worst(fit.coefficients);
    if (options.progress) options.progress("active sets", static_cast<double>(k) / most_steps);
    if (now <= 1 || now > 0.999 * before) break;
    before = now;
    box.update_multipliers(fit.coefficients);
  }
  return fit;
}

}  // namespace batten
