// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/constrained_surface.h>
#include <batten/fem/contradictions.h>
#include <batten/fem/cross_validation.h>
#include <batten/fem/difference_form.h>
#include <batten/fem/fit.h>
#include <batten/fem/near_interpolation.h>
#include <batten/fem/standard_error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace batten {
namespace {

Smoothing checked(const FitOptions& options) {
  if (options.degree < 2 || options.degree > 3)
    throw InvalidInput("fit_surface: expected degree 2 or 3, found " + std::to_string(options.degree));
  if (options.energy.null_degree() > 1)
    throw InvalidInput("fit_surface: expected an energy with first or second derivatives, found third ones alone");
  const Smoothing s = options.smoothing;
  if (s.kind == Smoothing::Kind::Fixed && !(s.value >= 0 && std::isfinite(s.value)))
    throw InvalidInput("fit_surface: expected a smoothing that is not negative, found " + number_text(s.value, 6));
  if (s.kind == Smoothing::Kind::Tolerance && !(s.value > 0 && std::isfinite(s.value)))
    throw InvalidInput("fit_surface: expected a positive tolerance, found " + number_text(s.value, 6));
  const Smoothing result = s.kind == Smoothing::Kind::Fixed && s.value == 0 ? Smoothing::none() : s;
  if (options.standard_error && result.kind != Smoothing::Kind::Automatic && result.kind != Smoothing::Kind::Fixed)
    throw InvalidInput("fit_surface: a standard error needs smoothing (automatic or lambda > 0), found interpolation");
  return result;
}

ScaledFit solve_automatic(FitProblem& problem, const FitOptions& options, FitResult& result) {
  auto found = timed(result.seconds, "cross-validation", [&] { return cross_validate(problem, options); });
  result.effective_degrees = found.effective_degrees;
  result.no_interior_minimum = !found.interior;
  result.search_iterations = static_cast<int>(std::ceil(found.work));
  result.refinement_iterations = static_cast<int>(std::ceil(found.refinement_work));
  if (!found.interior)
    result.notes.push_back("cross-validation: no interior minimum, lambda is the lower end " +
                           number_text(found.lambda, 6) + " of its range (the data look exact)");
  return timed(result.seconds, "solve",
               [&] { return solve_fixed(problem, found.lambda, options, std::move(found.start)); });
}

ScaledFit solve_none(FitProblem& problem, const FitOptions& options, FitResult& result) {
  if (options.energy.null_degree() == 0 && options.energy.order() == 1)
    result.notes.emplace_back(
        "membrane without smoothing: point values are not bounded for the membrane in two dimensions, the result "
        "depends on "
        "the cell size; consider the energy \"tension\"");
  if (problem.size() <= problem.system().size()) return interpolate(problem, options);
  result.notes.push_back("no smoothing: " + std::to_string(problem.size()) + " points outnumber " +
                         std::to_string(problem.system().size()) + " coefficients, lambda = 1e-14 is used");
  return solve_fixed(problem, interpolation_lambda, options);
}

/// Residuals, energy and fitted values in the units of the observations.
void measure(const Observations& o, const FitData& data, const FitProblem& problem, const ScaledFit& fit,
             FitResult& result) {
  const std::size_t n = o.size();
  result.fitted.resize(n);
  const auto count = static_cast<std::ptrdiff_t>(n);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    result.fitted[k] = result.solution.value(o.x[k], o.y[k]);
  }
  double square = 0, total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (std::isnan(result.fitted[i])) continue;
    const double r = std::abs(result.fitted[i] - o.value[i]), w = o.weight.empty() ? 1 : o.weight[i];
    if (w == 0) continue;
    square += w * r * r;
    total += w;
    if (r > result.largest_residual) {
      result.largest_residual = r;
      result.worst_point = i;
    }
  }
  result.rms_residual = std::sqrt(square / total);
  // The null element has no energy, so the energy of the scaled fit is the one of the surface, without the rounding of
  // its offset.
  result.energy = data.scale * data.scale *
                  evaluate_energy(problem.hierarchy().energy(), problem.hierarchy().finest().space, fit.coefficients);
  result.lambda = fit.lambda;
  result.iterations = fit.iterations;
  result.accuracy = fit.accuracy;
}

/// Whether all observations that were fitted are within their tolerances. The worst point becomes the one that is
/// farthest away in units of its own.
void judge_tolerances(const Observations& o, double unit, FitResult& result) {
  double worst = 0;
  for (std::size_t i = 0; i < o.size(); ++i) {
    if (std::isnan(result.fitted[i]) || (!o.weight.empty() && o.weight[i] == 0)) continue;
    const double share = std::abs(result.fitted[i] - o.value[i]) / tolerance_of(o, i, unit);
    if (share <= worst) continue;
    worst = share;
    result.worst_point = i;
  }
  constexpr double rounding = 1e-9;
  result.tolerance_reached = worst <= 1 + rounding;
  result.constraints->largest_violation = std::max(0., worst - 1);
}

void add_constraints(const ConstrainedFit& fit, double tolerance, FitResult& result) {
  result.constraints = fit.account;
  if (fit.growth) result.constraints->least_tolerance = *fit.growth * tolerance;
}

ScaledFit solve_for(const Smoothing& smoothing, FitProblem& problem, const FitOptions& options, FitResult& result) {
  switch (smoothing.kind) {
    case Smoothing::Kind::Automatic:
      return solve_automatic(problem, options, result);
    case Smoothing::Kind::Fixed:
      return timed(result.seconds, "solve", [&] { return solve_fixed(problem, smoothing.value, options); });
    default:
      return timed(result.seconds, "solve", [&] { return solve_none(problem, options, result); });
  }
}

}  // namespace

FitResult fit_surface(const Observations& observations, const Rectangle& region, const FitOptions& asked) {
  FitOptions options = asked;
  const Smoothing smoothing = options.smoothing = checked(asked);
  const bool is_within = smoothing.kind == Smoothing::Kind::Tolerance;
  std::vector<PhaseTime> seconds;
  PreparedData prepared = timed(seconds, "prepare", [&] {
    auto result = prepare(observations, region, options.energy, smoothing.kind == Smoothing::Kind::None);
    check_contradictions(observations, result.data.source, options);
    return result;
  });
  FitData& data = prepared.data;
  FitProblem problem = timed(seconds, "set up", [&] { return FitProblem(data, region, options); });

  FitResult result{.solution = Solution(region, options.degree, std::vector<double>(problem.system().size()))};
  result.seconds = std::move(seconds);
  ScaledFit fit;
  if (!is_within) fit = solve_for(smoothing, problem, options, result);
  if (is_within || has_bounds(options)) {
    auto found = timed(result.seconds, "constraints",
                       [&] { return fit_constrained(problem, data, observations, options, std::move(fit)); });
    add_constraints(found, smoothing.value, result);
    fit = std::move(found);
  }
  result.points_outside = prepared.outside;
  result.points_merged = prepared.merged;
  result.points_used = data.size() + prepared.merged;
  if (prepared.merged > 0)
    result.notes.push_back(std::to_string(prepared.merged) + " observations were averaged into coincident ones");

  std::vector<double> coefficients = fit.coefficients;
  for (double& c : coefficients) c *= data.scale;
  data.null_element.add_to(problem.hierarchy().finest().space, coefficients);
  result.solution = Solution(region, options.degree, std::move(coefficients));
  timed(result.seconds, "measure", [&] { measure(observations, data, problem, fit, result); });
  if (is_within) judge_tolerances(observations, smoothing.value, result);

  if (options.standard_error)
    timed(result.seconds, "standard error", [&] {
      auto found = uncertainty(problem, fit.coefficients, options);
      result.effective_degrees = found.effective_degrees;
      result.standard_error = std::move(found.standard_error);
      for (double& s : result.standard_error) s *= data.scale;
    });
  return result;
}

}  // namespace batten
