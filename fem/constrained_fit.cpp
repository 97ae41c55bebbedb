// SPDX-License-Identifier: MIT
#include <batten/fem/boxes.h>
#include <batten/fem/constrained_fit.h>
#include <batten/fem/elastic_energy.h>
#include <batten/fem/interior_point.h>
#include <batten/fem/near_interpolation.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

/// Limits as rows of an ElasticEnergy: those that give have one for each end.
struct ElasticLimits {
  std::vector<ElasticEnergy::Row> rows;
  std::vector<double> lower, upper, unit;

  void add(std::size_t i, double growth, double low, double high, double width) {
    rows.push_back({static_cast<std::ptrdiff_t>(i), growth});
    lower.push_back(low);
    upper.push_back(high);
    unit.push_back(width);
  }
};

ElasticLimits elastic(const MeasurementLimits& l) {
  ElasticLimits result;
  for (std::size_t i = 0; i < l.unit.size(); ++i) {
    if (!l.gives[i]) {
      result.add(i, 0, l.lower[i], l.upper[i], l.unit[i]);
      continue;
    }
    const double t = l.unit[i];
    result.add(i, -t, -infinity, l.upper[i] - t, t);
    result.add(i, t, l.lower[i] + t, infinity, t);
  }
  return result;
}

/// The least growth of tolerances that the other limits allow, with the energy moved there.
double least_growth(GridEnergy& energy, const MeasurementLimits& limits, const FitOptions& options) {
  constexpr double share_of_energy = 1e-5;  // of what is minimised: the growth is right to about that
  constexpr double room = 0.1;
  const auto v = energy.values();
  double growth = 1;
  for (std::size_t i = 0; i < v.size(); ++i)
    if (limits.gives[i])
      growth = std::max(growth, 1 + std::max(v[i] - limits.upper[i], limits.lower[i] - v[i]) / limits.unit[i]);
  const double cost = std::max(energy.energy(), least_energy) / share_of_energy;
  ElasticLimits all = elastic(limits);
  ElasticEnergy whole(energy, all.rows, cost, 1.1 * growth);
  Boxes boxes(all.lower, all.upper, all.unit);
  boxes.start(whole.values(), room * cost * growth / boxes.count());
  InteriorPointOptions own = options_for(options);
  own.gap = 1e-4;
  minimise(whole, boxes, own);
  return whole.theta();
}

void account_for(const InteriorPointResult& found, const FeasibleSet& set, ConstrainedFit& fit) {
  fit.account.energy_gap = found.gap;
  fit.account.largest_violation = found.violation;
  fit.account.active = set.active();
}

}  // namespace

ConstrainedFit fit_within(PenalisedProblem& problem, const MeasurementLimits& limits, std::vector<double> start,
                          const FitOptions& options) {
  ConstrainedFit fit;
  GridEnergy energy(problem, limits.pull, std::move(start));
  Boxes boxes(limits.lower, limits.upper, limits.unit);
  const auto attempt = [&] {
    boxes.start(energy.values(), limits.rise * std::max(energy.energy(), least_energy) / boxes.count());
    const auto found = minimise(energy, boxes, options_for(options));
    account_for(found, boxes, fit);
    return found.converged;
  };
  if (!attempt() && std::find(limits.gives.begin(), limits.gives.end(), true) != limits.gives.end()) {
    const double growth = least_growth(energy, limits, options);
    if (growth >= 1)
      fit.growth = growth;
    else
      attempt();
  }
  fit.coefficients = energy.coefficients();
  fit.account.cycles = fit.iterations = energy.cycles();
  fit.accuracy = std::sqrt(std::max(0., fit.account.energy_gap));
  return fit;
}

ConstrainedFit fit_within(PenalisedProblem& problem, std::span<const double> tolerances, const FitOptions& options) {
  const auto is_within = [&](std::size_t i) { return std::abs(problem.value()[i]) <= tolerances[i]; };
  std::size_t within = 0;
  while (within < tolerances.size() && is_within(within)) ++within;
  if (within == tolerances.size()) {  // the null element, which was taken off the data, will do
    ConstrainedFit nothing;
    nothing.coefficients.resize(problem.unknowns());
    return nothing;
  }
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
