// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/cross_validation.h>
#include <batten/fem/difference_form.h>
#include <batten/fem/near_interpolation.h>
#include <batten/flows/coupled_problem.h>
#include <batten/flows/divergence_share.h>
#include <batten/flows/extended_problem.h>
#include <batten/flows/flow_tolerance.h>
#include <batten/flows/mean_velocity.h>
#include <batten/flows/quadratic_pairs.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace batten {
namespace {

bool is_potential(FlowModel model) { return model == FlowModel::Irrotational; }

Smoothing checked(const FlowOptions& options) {
  if (options.degree < 3 || options.degree > 5)
    throw InvalidInput("fit_flow: expected degree 3 to 5, found " + std::to_string(options.degree));
  const Smoothing s = options.smoothing;
  const bool is_general = options.model == FlowModel::General;
  if (is_general && !(options.ratio > 0 && std::isfinite(options.ratio)))
    throw InvalidInput("fit_flow: expected a positive ratio of energies, found " + number_text(options.ratio, 6));
  if (s.kind == Smoothing::Kind::Fixed && !(s.value >= 0 && std::isfinite(s.value)))
    throw InvalidInput("fit_flow: expected a smoothing that is not negative, found " + number_text(s.value, 6));
  if (s.kind == Smoothing::Kind::Tolerance && !(s.value > 0 && std::isfinite(s.value)))
    throw InvalidInput("fit_flow: expected a positive tolerance, found " + number_text(s.value, 6));
  return s.kind == Smoothing::Kind::Fixed && s.value == 0 ? Smoothing::none() : s;
}

FitOptions scalar_options(const FlowOptions& options, const Rectangle& region) {
  FitOptions result;
  result.aspect = geometry_of(options).aspect(region);
  result.energy = energy_of(options.model);
  result.degree = options.degree;
  result.limits = options.limits;
  result.seed = options.seed;
  result.progress = options.progress;
  return result;
}

ScaledFit solve_automatic(PenalisedProblem& problem, const FitOptions& options, FlowResult& result) {
  auto found = timed(result.seconds, "cross-validation", [&] { return cross_validate(problem, options); });
  result.effective_degrees = found.effective_degrees;
  result.no_interior_minimum = !found.interior;
  result.search_iterations = static_cast<int>(std::ceil(found.work));
  if (!found.interior)
    result.notes.push_back("cross-validation: no interior minimum, lambda is the lower end " +
                           number_text(found.lambda, 6) + " of its range (the data look exact)");
  return timed(result.seconds, "solve",
               [&] { return solve_fixed(problem, found.lambda, options, std::move(found.start)); });
}

ScaledFit solve_none(PenalisedProblem& problem, const FitOptions& options, FlowResult& result) {
  if (options.energy.order() < 3)
    result.notes.emplace_back(
        "model slow without smoothing: point velocities are not bounded by its energy, each point gets a spike that "
        "grows with the logarithm of the cell size; consider the model smooth");
  if (problem.size() <= problem.unknowns()) return interpolate(problem, options);
  result.notes.push_back("no smoothing: " + std::to_string(problem.size()) + " components of velocities outnumber " +
                         std::to_string(problem.unknowns()) +
                         " coefficients, lambda = " + number_text(interpolation_lambda, 6) + " is used");
  return solve_fixed(problem, interpolation_lambda, options);
}

ScaledFit solve_for(const FlowOptions& flow, PenalisedProblem& problem, FlowData& data, const FitOptions& options,
                    FlowResult& result) {
  const auto solved = [&](auto&& work) { return timed(result.seconds, "solve", work); };
  switch (flow.smoothing.kind) {
    case Smoothing::Kind::Automatic:
      return solve_automatic(problem, options, result);
    case Smoothing::Kind::Fixed:
      return solved([&] { return solve_fixed(problem, flow.smoothing.value, options); });
    case Smoothing::Kind::None:
      return solved([&] { return solve_none(problem, options, result); });
    default:
      return solved([&] { return fit_flow_within(problem, data, flow, options, result); });
  }
}

struct Grid {
  const Rectangle& region;
  FlowGeometry geometry;
};

Solution with_zero_mean(const Rectangle& region, int degree, std::vector<double> c) {
  const double mean = mean_value(Solution(region, degree, c));
  for (double& v : c) v -= mean;
  return Solution(region, degree, std::move(c));
}

/// The spline of scaled coefficients and a null element in the units of the observations, times the length of the
/// longer side.
Solution in_units(std::span<const double> scaled, double scale, const QuadraticFunction& null_element,
                  const SplineSpace& space, const Grid& grid) {
  std::vector<double> c(scaled.begin(), scaled.end());
  for (double& v : c) v *= scale;
  null_element.add_to(space, c);
  for (double& v : c) v *= grid.geometry.longer_side(grid.region);
  return with_zero_mean(grid.region, space.x.degree(), std::move(c));
}

/// The same field, where φ is orthogonal to the gradients that are rotations as well and cost nothing.
FlowField given_to_stream(const FlowField& field, const SplineSpace& space, const FlowSides& sides) {
  const auto pairs = exchangeable_pairs(field.region(), sides);
  const auto spline = [&](const QuadraticFunction& q) {
    std::vector<double> coefficients(space.size());
    q.add_to(space, coefficients);
    return Solution(field.region(), field.degree(), std::move(coefficients));
  };
  const auto count = static_cast<Eigen::Index>(pairs.size());
  Eigen::MatrixXd gram(count, count);
  Eigen::VectorXd right(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const FlowField one({}, spline(pairs[static_cast<std::size_t>(i)].phi));
    right[i] = inner_product(one, FlowField({}, field.potential()));
    for (Eigen::Index j = 0; j < count; ++j)
      gram(i, j) = inner_product(one, FlowField({}, spline(pairs[static_cast<std::size_t>(j)].phi)));
  }
  const Eigen::VectorXd amount = gram.ldlt().solve(right);
  const auto moved = [&](const Solution& p, QuadraticFunction QuadraticPair::*part) {
    std::vector<double> c(p.coefficients().begin(), p.coefficients().end());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Solution less = spline(pairs[i].*part);
      for (std::size_t k = 0; k < c.size(); ++k) c[k] -= amount[static_cast<Eigen::Index>(i)] * less.coefficients()[k];
    }
    return with_zero_mean(field.region(), field.degree(), std::move(c));
  };
  return FlowField(moved(*field.stream(), &QuadraticPair::psi), moved(*field.potential(), &QuadraticPair::phi));
}

FlowField field_of(const FlowOptions& options, const ScaledFit& fit, const FlowData& data, const SplineSpace& space,
                   const Rectangle& region) {
  const std::span<const double> c = fit.coefficients;
  const double scale = data.rows.scale;
  const Grid grid{region, geometry_of(options)};
  Solution part = in_units(c.first(space.size()), scale, data.null_element, space, grid);
  if (options.model == FlowModel::Irrotational) return FlowField({}, std::move(part), grid.geometry);
  if (options.model != FlowModel::General) return FlowField(std::move(part), {}, grid.geometry);
  FlowField field(std::move(part), in_units(c.last(space.size()), scale, data.null_potential, space, grid),
                  grid.geometry);
  return options.geographic ? field : given_to_stream(field, space, options.sides);
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

std::unique_ptr<PenalisedProblem> make_problem(const FlowData& data, const Rectangle& region,
                                               const FlowOptions& options) {
  const FitOptions scalar = scalar_options(options, region);
  std::unique_ptr<PenalisedProblem> problem;
  std::vector<ExtraFunction> functions;
  if (options.model == FlowModel::General) {
    auto both = std::make_unique<CoupledProblem>(data, region, scalar, options);
    for (const bool is_potential : {false, true})
      for (const SideFunction& f : side_functions(options.sides, {is_potential, true}))
        functions.push_back(both->extra_function(f, is_potential));
    problem = std::move(both);
  } else {
    const FlowPart part{is_potential(options.model), false};
    auto one = std::make_unique<FitProblem>(data.rows, region, scalar, side_conditions(options.sides, part));
    for (const SideFunction& f : side_functions(options.sides, part)) functions.push_back(extra_function(f, *one));
    problem = std::move(one);
  }
  if (functions.empty()) return problem;
  return std::make_unique<ExtendedProblem>(
      std::move(problem), std::move(functions), options.limits,
      [&data, options](const Rectangle& grid) { return make_problem(data, grid, options); });
}

/// Of the scaled coefficients, which differ from the splines by what has no energy.
void measure_energy(const FlowOptions& options, const ScaledFit& fit, double scale, const SplineSpace& space,
                    FlowResult& result) {
  const auto energy = [&](std::span<const double> c) {
    return scale * scale * evaluate_energy(energy_of(options.model), space, c);
  };
  const std::span<const double> c = fit.coefficients;
  result.energy = energy(c.first(space.size()));
  if (options.model == FlowModel::Irrotational) result.potential_energy = result.energy;
  if (options.model != FlowModel::General) return;
  result.potential_energy = options.ratio * energy(c.last(space.size()));
  result.energy += result.potential_energy;
}

/// Fluxes and mean flows, which are differences of ψ or φ between opposite sides.
void measure_sides(const FlowOptions& options, FlowResult& result) {
  const Rectangle& region = result.field.region();
  const auto& [x, y] = region;
  // At the mid latitude.
  const double unit_y = result.field.geometry().length_y(), unit_x = unit_y / result.field.geometry().aspect(region);
  const bool potential = is_potential(options.model);
  const Solution& p = potential ? *result.field.potential() : *result.field.stream();
  const double low = p.value(x.lower(), y.lower());
  const double across = p.value(x.upper(), y.lower()) - low, upwards = p.value(x.lower(), y.upper()) - low;
  for (const SideFunction& f : side_functions(options.sides, {potential, false})) {
    const bool is_x = f.along == SideFunction::Along::X;
    const double difference = is_x ? across : upwards;
    if ((is_x ? options.sides.left : options.sides.bottom) == FlowSide::Periodic)
      (is_x == potential ? result.mean_u : result.mean_v) =
          (is_x && !potential ? -1 : 1) * difference / (is_x ? x.length() * unit_x : y.length() * unit_y);
    else
      result.flux = is_x ? -difference : difference;
  }
  if (options.model != FlowModel::General) return;
  const auto mean = mean_velocity(result.field);  // both ψ and φ may hold it
  const bool is_channel = is_wall(options.sides.bottom);
  if (result.flux) result.flux = is_channel ? mean.u * y.length() * unit_y : mean.v * x.length() * unit_x;
  result.mean_u = result.mean_v = std::nullopt;
  if (!options.sides.have(FlowSide::Periodic)) return;
  result.mean_u = mean.u;
  result.mean_v = mean.v;
}

constexpr double missed_by_interpolation = 1e-8;  // of the range of velocities: a hundred times what it aims at

double largest_of(const std::vector<double>& values) {
  double result = 0;
  for (const double v : values) result = std::max(result, std::abs(v));
  return result;
}

/// What the user should know of how far the fit got.
void add_notes(const Smoothing& smoothing, const FlowOptions& options, bool is_missed, FlowResult& result) {
  if (result.points_merged > 0)
    result.notes.push_back(std::to_string(result.points_merged) + " observations were averaged into coincident ones");
  if (!result.constraints && result.accuracy > 1e3 * options.limits.accuracy)
    result.notes.push_back("the solver stopped after " + std::to_string(result.iterations) +
                           " iterations at an estimated relative error of " + number_text(result.accuracy, 2) +
                           " in the energy norm");
  if (smoothing.kind == Smoothing::Kind::None && is_missed)
    result.notes.push_back("no smoothing: the field misses the vectors by up to " +
                           number_text(result.largest_residual, 2) +
                           "; more cells, or vectors that are farther apart, would let it go through them");
}

}  // namespace

FlowResult fit_flow(const VectorObservations& observations, const Rectangle& region, const FlowOptions& options) {
  FlowOptions checked_options = options;
  const Smoothing smoothing = checked_options.smoothing = checked(options);
  std::vector<PhaseTime> seconds;
  FlowData data = timed(seconds, "prepare", [&] {
    return prepare_flow(observations, region, options, smoothing.kind == Smoothing::Kind::None);
  });
  if (smoothing.kind == Smoothing::Kind::Tolerance) check_contradictions(observations, data, options);
  const auto problem = timed(seconds, "set up", [&] { return make_problem(data, region, options); });
  const FitOptions scalar = scalar_options(options, region);
  const SplineSpace space = finest_space(region, options.degree, {scalar.aspect});

  FlowResult result{.field = field_of(options, {std::vector<double>(problem->unknowns())}, data, space, region)};
  result.seconds = std::move(seconds);
  ScaledFit fit = solve_for(checked_options, *problem, data, scalar, result);
  const double missed = largest_of(problem->residuals(fit.coefficients));
  fit.coefficients = problem->whole(fit.coefficients);
  result.points_outside = data.outside;
  result.points_merged = data.merged;
  result.points_used = data.rows.size() / 2 + data.merged;
  result.field = field_of(options, fit, data, space, region);
  measure_sides(options, result);
  timed(result.seconds, "measure", [&] {
    measure(observations, result);
    result.largest_divergence = divergence_share(result.field, options.seed);
    measure_energy(options, fit, data.rows.scale, space, result);
  });
  result.lambda = fit.lambda;
  result.iterations = fit.iterations;
  result.accuracy = fit.accuracy;
  if (smoothing.kind == Smoothing::Kind::Tolerance) judge_tolerance(observations, checked_options, result);
  add_notes(smoothing, options, missed > missed_by_interpolation && problem->size() <= problem->unknowns(), result);
  return result;
}

}  // namespace batten
