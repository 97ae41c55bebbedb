// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/cross_validation.h>
#include <batten/fem/difference_form.h>
#include <batten/fem/near_interpolation.h>
#include <batten/flows/flow_data.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace batten {
namespace {

Smoothing checked(const FlowOptions& options) {
  if (options.degree < 3 || options.degree > 5)
    throw InvalidInput("fit_flow: expected degree 3 to 5, found " + std::to_string(options.degree));
  const Smoothing s = options.smoothing;
  if (s.kind == Smoothing::Kind::Fixed && !(s.value >= 0 && std::isfinite(s.value)))
    throw InvalidInput("fit_flow: expected a smoothing that is not negative, found " + number_text(s.value, 6));
  if (s.kind == Smoothing::Kind::Tolerance && !(s.value > 0 && std::isfinite(s.value)))
    throw InvalidInput("fit_flow: expected a positive tolerance, found " + number_text(s.value, 6));
  return s.kind == Smoothing::Kind::Fixed && s.value == 0 ? Smoothing::none() : s;
}

FitOptions scalar_options(const FlowOptions& options) {
  FitOptions result;
  result.energy = energy_of(options.model);
  result.degree = options.degree;
  result.limits = options.limits;
  result.seed = options.seed;
  result.progress = options.progress;
  return result;
}

ScaledFit solve_automatic(FitProblem& problem, const FitData& rows, const FitOptions& options, FlowResult& result) {
  auto found = timed(result.seconds, "cross-validation", [&] { return cross_validate(problem, rows, options); });
  result.effective_degrees = found.effective_degrees;
  result.no_interior_minimum = !found.interior;
  result.search_iterations = static_cast<int>(std::ceil(found.work));
  if (!found.interior)
    result.notes.push_back("cross-validation: no interior minimum, lambda is the lower end " +
                           number_text(found.lambda, 6) + " of its range (the data look exact)");
  return timed(result.seconds, "solve",
               [&] { return solve_fixed(problem, found.lambda, options, std::move(found.start)); });
}

ScaledFit solve_none(FitProblem& problem, const FitOptions& options, FlowResult& result) {
  if (options.energy.order() < 3)
    result.notes.push_back(
        "model slow without smoothing: point velocities are not bounded by its energy, each point gets a spike that "
        "grows with the logarithm of the cell size; consider the model smooth");
  if (problem.size() <= problem.system().size()) return interpolate(problem, options);
  result.notes.push_back("no smoothing: " + std::to_string(problem.size()) + " components of velocities outnumber " +
                         std::to_string(problem.system().size()) + " coefficients, lambda = 1e-14 is used");
  return solve_fixed(problem, interpolation_lambda, options);
}

ScaledFit solve_for(const Smoothing& smoothing, FitProblem& problem, const FitData& rows, const FitOptions& options,
                    FlowResult& result) {
  const auto solved = [&](auto&& work) { return timed(result.seconds, "solve", work); };
  switch (smoothing.kind) {
    case Smoothing::Kind::Automatic:
      return solve_automatic(problem, rows, options, result);
    case Smoothing::Kind::Fixed:
      return solved([&] { return solve_fixed(problem, smoothing.value, options); });
    case Smoothing::Kind::None:
      return solved([&] { return solve_none(problem, options, result); });
    default:
      return solved([&] {
        const std::vector<double> tolerances(problem.size(), smoothing.value / rows.scale);
        return interpolate_within(problem, tolerances, options);
      });
  }
}

/// The spline of the scaled coefficients and the null element in the units of the observations, with zero mean.
Solution potential_of(const ScaledFit& fit, const FlowData& data, const SplineSpace& space, const Rectangle& region,
                      int degree) {
  std::vector<double> c = fit.coefficients;
  for (double& v : c) v *= data.rows.scale;
  data.null_element.add_to(space, c);
  for (double& v : c) v *= data.null_element.length;
  const double mean = mean_value(Solution(region, degree, c));
  for (double& v : c) v -= mean;
  return Solution(region, degree, std::move(c));
}

/// Largest |u_x + v_y| over largest |∇v| by central differences.
double divergence_share(const FlowField& field, std::uint64_t seed) {
  constexpr int points = 2000;
  constexpr double part_of_cell = 1e-3;
  const auto &ix = field.region().x, &iy = field.region().y;
  const double dx = part_of_cell * ix.finest_cell_length(), dy = part_of_cell * iy.finest_cell_length();
  std::mt19937_64 random(seed);
  const auto within = [&](const Interval& interval, double margin) {
    const double share = static_cast<double>(random() >> 11) * 0x1p-53;
    return interval.lower() + margin + share * (interval.length() - 2 * margin);
  };
  double divergence = 0, gradient = 0;
  for (int k = 0; k < points; ++k) {
    const double x = within(ix, dx), y = within(iy, dy);
    const auto left = field.velocity(x - dx, y), right = field.velocity(x + dx, y);
    const auto low = field.velocity(x, y - dy), high = field.velocity(x, y + dy);
    const double u_x = (right.u - left.u) / (2 * dx), v_x = (right.v - left.v) / (2 * dx);
    const double u_y = (high.u - low.u) / (2 * dy), v_y = (high.v - low.v) / (2 * dy);
    divergence = std::max(divergence, std::abs(u_x + v_y));
    gradient = std::max(gradient, std::sqrt(u_x * u_x + v_x * v_x + u_y * u_y + v_y * v_y));
  }
  return gradient > 0 ? divergence / gradient : 0;
}

/// Residuals and fitted velocities in the units of the observations.
void measure(const VectorObservations& o, FlowResult& result) {
  const auto count = static_cast<std::ptrdiff_t>(o.size());
  result.fitted_u.resize(o.size());
  result.fitted_v.resize(o.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const auto at = result.field.velocity(o.x[k], o.y[k]);
    result.fitted_u[k] = at.u;
    result.fitted_v[k] = at.v;
  }
  double square = 0, total = 0;
  for (std::size_t i = 0; i < o.size(); ++i) {
    const double w = o.weight.empty() ? 1 : o.weight[i];
    if (std::isnan(result.fitted_u[i]) || w == 0) continue;
    const double r = std::hypot(result.fitted_u[i] - o.u[i], result.fitted_v[i] - o.v[i]);
    square += w * r * r;
    total += w;
    if (r > result.largest_residual) {
      result.largest_residual = r;
      result.worst_point = i;
    }
  }
  result.rms_residual = std::sqrt(square / total);
}

/// Whether u and v of all observations that were fitted are within the tolerance.
bool within(const VectorObservations& o, double tolerance, const FlowResult& result) {
  for (std::size_t i = 0; i < o.size(); ++i) {
    if (std::isnan(result.fitted_u[i]) || (!o.weight.empty() && o.weight[i] == 0)) continue;
    if (std::max(std::abs(result.fitted_u[i] - o.u[i]), std::abs(result.fitted_v[i] - o.v[i])) > tolerance)
      return false;
  }
  return true;
}

FlowField as_field(FlowModel model, Solution potential) {
  if (model == FlowModel::Irrotational) return FlowField({}, std::move(potential));
  return FlowField(std::move(potential));
}

}  // namespace

FlowResult fit_flow(const VectorObservations& observations, const Rectangle& region, const FlowOptions& options) {
  const Smoothing smoothing = checked(options);
  const FitOptions scalar = scalar_options(options);
  std::vector<PhaseTime> seconds;
  const FlowData data = timed(seconds, "prepare", [&] {
    return prepare_flow(observations, region, options.model, smoothing.kind == Smoothing::Kind::None);
  });
  FitProblem problem = timed(seconds, "set up", [&] { return FitProblem(data.rows, region, scalar); });
  const SplineSpace& space = problem.hierarchy().finest().space;

  FlowResult result{.field = as_field(options.model, {region, options.degree, std::vector<double>(space.size())})};
  result.seconds = std::move(seconds);
  const ScaledFit fit = solve_for(smoothing, problem, data.rows, scalar, result);
  result.points_outside = data.outside;
  result.points_merged = data.merged;
  result.points_used = data.rows.size() / 2 + data.merged;
  if (data.merged > 0)
    result.notes.push_back(std::to_string(data.merged) + " observations were averaged into coincident ones");
  result.field = as_field(options.model, potential_of(fit, data, space, region, options.degree));
  timed(result.seconds, "measure", [&] {
    measure(observations, result);
    result.largest_divergence = divergence_share(result.field, options.seed);
    result.energy = data.rows.scale * data.rows.scale * evaluate_energy(scalar.energy, space, fit.coefficients);
  });
  result.lambda = fit.lambda;
  result.iterations = fit.iterations;
  result.accuracy = fit.accuracy;
  if (smoothing.kind == Smoothing::Kind::Tolerance)
    result.tolerance_reached = within(observations, smoothing.value, result);
  return result;
}

}  // namespace batten
