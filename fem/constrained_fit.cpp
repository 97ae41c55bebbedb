// SPDX-License-Identifier: MIT
#include <batten/fem/balls.h>
#include <batten/fem/boxes.h>
#include <batten/fem/constrained_fit.h>
#include <batten/fem/elastic_energy.h>
#include <batten/fem/interior_point.h>
#include <batten/fem/near_interpolation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace batten {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double least_energy = 1e-8 / 2;  // of J = E / 2 for data of range 1

InteriorPointOptions options_for(const FitOptions& options) {
  InteriorPointOptions result;
  result.least_energy = least_energy;
  if (options.progress) result.progress = [&options](double done) { options.progress("interior point", done); };
  return result;
}

/// The null element, which was taken off the data, will do.
ConstrainedFit nothing(const PenalisedProblem& problem) {
  ConstrainedFit fit;
  fit.coefficients.resize(problem.unknowns());
  return fit;
}

/// The closer a start is to the middle of its limits, the fewer steps follow: data are nearly interpolated.
std::vector<double> middle(PenalisedProblem& problem, std::span<const double> tolerances, const FitOptions& options,
                           int& cycles) {
  constexpr int most_solutions = 3;
  constexpr double near_enough = 0.3;
  IterationLimits limits = options.limits;
  limits.accuracy = std::max(limits.accuracy, 1e-4);
  std::vector<double> c(problem.unknowns()), step(c.size());
  problem.set(interpolation_lambda);
  for (int k = 0; k < most_solutions; ++k) {
    const auto residual = problem.residuals(c);
    double worst = 0;
    for (std::size_t i = 0; i < residual.size(); ++i) worst = std::max(worst, std::abs(residual[i]) / tolerances[i]);
    if (worst < near_enough) break;
    std::fill(step.begin(), step.end(), 0.);
    cycles += problem.solve(problem.right_side(problem.weight(), residual), step, limits, 0).iterations + 1;
    for (std::size_t i = 0; i < c.size(); ++i) c[i] += step[i];
  }
  return c;
}

/// Limits whose tolerances grow with θ, from θ = `none`.
struct Elastic {
  std::vector<ElasticEnergy::Row> rows;
  std::unique_ptr<FeasibleSet> set;
  double none;
};

/// Tolerances have a row for each end: v - t θ <= upper - t and v + t θ >= lower + t.
Elastic elastic(const MeasurementLimits& l) {
  Elastic result{{}, nullptr, 1};
  std::vector<double> lower, upper, unit;
  const auto add = [&](std::size_t i, double growth, double low, double high) {
    result.rows.push_back({static_cast<std::ptrdiff_t>(i), growth});
    lower.push_back(low);
    upper.push_back(high);
    unit.push_back(l.unit[i]);
  };
  for (std::size_t i = 0; i < l.unit.size(); ++i) {
    const double t = l.unit[i];
    if (!l.gives[i]) add(i, 0, l.lower[i], l.upper[i]);
    if (l.gives[i]) add(i, -t, -infinity, l.upper[i] - t);
    if (l.gives[i]) add(i, t, l.lower[i] + t, infinity);
  }
  result.set = std::make_unique<Boxes>(lower, upper, unit);
  return result;
}

/// Balls of pairs of rows, whose radii are (1 + θ) radius.
Elastic elastic(const std::vector<double>& centre, double radius) {
  Elastic result{{}, nullptr, 0};
  const std::size_t pairs = centre.size() / 2;
  for (std::size_t k = 0; k < pairs; ++k) {
    const auto first = static_cast<std::ptrdiff_t>(2 * k);
    result.rows.insert(result.rows.end(), {{-1, radius}, {first, 0}, {first + 1, 0}});
  }
  result.set = std::make_unique<Balls>(centre, std::vector<double>(pairs, radius),
                                       Balls::Options{.dimension = 2, .is_elastic = true});
  return result;
}

/// The least growth of tolerances that other limits allow, with the energy moved there. `violation`: where it is now.
double least_growth(GridEnergy& energy, Elastic limits, double violation, const FitOptions& options) {
  constexpr double share_of_energy = 1e-5;  // of what is minimised: the growth is right to about that
  constexpr double room = 0.1;
  const double growth = 1.1 * (1 + violation), cost = std::max(energy.energy(), least_energy) / share_of_energy;
  ElasticEnergy whole(energy, limits.rows, cost, growth - 1 + limits.none);
  limits.set->start(whole.values(), room * cost * growth / limits.set->count());
  InteriorPointOptions own = options_for(options);
  own.gap = 1e-4;
  minimise(whole, *limits.set, own);
  return whole.theta() + 1 - limits.none;
}

/// The least energy in the set; where that is empty, of the set with the least growth.
template <typename MakeElastic>
ConstrainedFit fit_in(GridEnergy& energy, FeasibleSet& set, double rise, const FitOptions& options,
                      MakeElastic&& make_elastic) {
  ConstrainedFit fit;
  const auto attempt = [&] {
    set.start(energy.values(), rise * std::max(energy.energy(), least_energy) / set.count());
    const auto found = minimise(energy, set, options_for(options));
    fit.account.energy_gap = found.gap;
    fit.account.largest_violation = found.violation;
    fit.account.active = set.active();
    return found.converged;
  };
  bool is_found = attempt();
  std::optional<Elastic> limits = is_found ? std::nullopt : make_elastic();
  for (int again = 0; !is_found && !limits && again < 2; ++again) {  // there is one, but it takes larger forces
    rise *= 1000;
    is_found = attempt();
  }
  if (limits) {
    const double growth = least_growth(energy, std::move(*limits), set.violation(energy.values()), options);
    if (growth >= 1) fit.growth = growth;
    if (growth < 1) attempt();
  }
  fit.coefficients = energy.coefficients();
  fit.account.cycles = fit.iterations = energy.cycles();
  fit.accuracy = std::sqrt(std::max(0., fit.account.energy_gap));
  return fit;
}

}  // namespace

ConstrainedFit fit_within(PenalisedProblem& problem, const MeasurementLimits& limits, std::vector<double> start,
                          const FitOptions& options) {
  GridEnergy energy(problem, limits.pull, std::move(start));
  Boxes boxes(limits.lower, limits.upper, limits.unit);
  const bool can_give = std::find(limits.gives.begin(), limits.gives.end(), true) != limits.gives.end();
  return fit_in(energy, boxes, limits.rise, options,
                [&] { return can_give ? std::optional(elastic(limits)) : std::nullopt; });
}

ConstrainedFit fit_within_balls(PenalisedProblem& problem, double radius, const std::vector<double>& factors,
                                const FitOptions& options) {
  std::vector<double> centre = problem.value(), tolerances;
  for (std::size_t i = 0; i < centre.size(); ++i) {
    centre[i] /= factors[i];
    tolerances.push_back(radius * factors[i] / std::numbers::sqrt2);  // the box in the ball
  }
  Balls balls(centre, std::vector<double>(centre.size() / 2, radius), {.dimension = 2});
  if (balls.violation(std::vector<double>(centre.size())) <= 0) return nothing(problem);
  int cycles = 0;
  GridEnergy energy(problem, {}, middle(problem, tolerances, options, cycles));
  energy.divide_rows(factors);
  auto fit = fit_in(energy, balls, 1, options, [&] { return std::optional(elastic(centre, radius)); });
  fit.iterations = fit.account.cycles += cycles;
  return fit;
}

ConstrainedFit fit_within(PenalisedProblem& problem, std::span<const double> tolerances, const FitOptions& options) {
  const auto is_within = [&](std::size_t i) { return std::abs(problem.value()[i]) <= tolerances[i]; };
  std::size_t within = 0;
  while (within < tolerances.size() && is_within(within)) ++within;
  if (within == tolerances.size()) return nothing(problem);
  MeasurementLimits limits;
  limits.unit.assign(tolerances.begin(), tolerances.end());
  limits.gives.assign(tolerances.size(), true);
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    limits.lower.push_back(problem.value()[i] - tolerances[i]);
    limits.upper.push_back(problem.value()[i] + tolerances[i]);
  }
  int cycles = 0;
  auto fit = fit_within(problem, limits, middle(problem, tolerances, options, cycles), options);
  fit.iterations = fit.account.cycles += cycles;
  return fit;
}

}  // namespace batten
