// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/cross_validation.h>
#include <batten/fem/difference_form.h>
#include <batten/fem/fit.h>
#include <batten/fem/fit_problem.h>
#include <batten/fem/near_interpolation.h>
#include <batten/fem/standard_error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
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

double tolerance_of(const Observations& o, std::size_t i, double unit) {
  return o.tolerance.empty() ? unit : unit * o.tolerance[i];
}

/// Coincident points whose boxes z ± tolerance do not meet cannot both be fitted.
void check_tolerance(const Observations& o, double unit) {
  if (!o.tolerance.empty() && o.tolerance.size() != o.size())
    throw InvalidInput("fit_surface: expected a tolerance for each of " + std::to_string(o.size()) +
                       " observations, found " + std::to_string(o.tolerance.size()));
  for (std::size_t i = 0; i < o.tolerance.size(); ++i)
    if (!(o.tolerance[i] > 0 && std::isfinite(o.tolerance[i])))
      throw InvalidInput("fit_surface: expected positive tolerances, found " + number_text(o.tolerance[i], 6) +
                         " at observation " + std::to_string(i + 1));
  const auto top = [&](std::size_t i) { return o.value[i] + tolerance_of(o, i, unit); };
  const auto bottom = [&](std::size_t i) { return o.value[i] - tolerance_of(o, i, unit); };
  // at one place: the box with the lowest top and the one with the highest bottom
  std::map<std::pair<double, double>, std::pair<std::size_t, std::size_t>> extremes;
  for (std::size_t i = 0; i < o.size(); ++i) {
    const auto [at, is_new] = extremes.try_emplace({o.x[i], o.y[i]}, i, i);
    auto& [low, high] = at->second;
    if (top(i) < top(low)) low = i;
    if (bottom(i) > bottom(high)) high = i;
    if (bottom(high) > top(low))
      throw InvalidInput("fit_surface: expected values at one place within their tolerances of each other, found " +
                         number_text(o.value[low], 6) + " (observation " + std::to_string(low + 1) + ") and " +
                         number_text(o.value[high], 6) + " (observation " + std::to_string(high + 1) + ") at (" +
                         number_text(o.x[i], 6) + ", " + number_text(o.y[i], 6) + ")");
  }
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

ScaledFit solve_within(FitProblem& problem, const FitData& data, const Observations& o, const FitOptions& options) {
  std::vector<double> tolerances;
  for (const std::size_t i : problem.order())
    tolerances.push_back(tolerance_of(o, data.source[i], options.smoothing.value) / data.scale);
  return interpolate_within(problem, tolerances, options);
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
  result.tolerance_reached = worst <= 1;
}

}  // namespace

FitResult fit_surface(const Observations& observations, const Rectangle& region, const FitOptions& options) {
  const Smoothing smoothing = checked(options);
  std::vector<PhaseTime> seconds;
  const bool merge = smoothing.kind == Smoothing::Kind::None;
  const PreparedData prepared = timed(seconds, "prepare", [&] {
    auto result = prepare(observations, region, options.energy, merge);
    if (smoothing.kind == Smoothing::Kind::Tolerance) check_tolerance(observations, smoothing.value);
    return result;
  });
  const FitData& data = prepared.data;
  FitProblem problem = timed(seconds, "set up", [&] { return FitProblem(data, region, options); });

  FitResult result{.solution = Solution(region, options.degree, std::vector<double>(problem.system().size()))};
  result.seconds = std::move(seconds);
  ScaledFit fit;
  switch (smoothing.kind) {
    case Smoothing::Kind::Automatic:
      fit = solve_automatic(problem, options, result);
      break;
    case Smoothing::Kind::Fixed:
      fit = timed(result.seconds, "solve", [&] { return solve_fixed(problem, smoothing.value, options); });
      break;
    case Smoothing::Kind::None:
      fit = timed(result.seconds, "solve", [&] { return solve_none(problem, options, result); });
      break;
    case Smoothing::Kind::Tolerance:
      fit = timed(result.seconds, "solve", [&] { return solve_within(problem, data, observations, options); });
      break;
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
  if (smoothing.kind == Smoothing::Kind::Tolerance) judge_tolerances(observations, smoothing.value, result);

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
