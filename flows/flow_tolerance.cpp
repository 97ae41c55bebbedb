// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/balls.h>
#include <batten/fem/boxes.h>
#include <batten/fem/constrained_fit.h>
#include <batten/fem/null_element.h>
#include <batten/flows/flow_tolerance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

namespace batten {
namespace {

/// What a row measures is so many times a component of a velocity.
std::vector<double> factors_of(const PenalisedProblem& problem, const FlowData& data) {
  std::vector<double> factors;
  for (const std::size_t row : problem.order())
    factors.push_back(data.rows.kind[row] == Measured::SlopeX ? data.stretch[row] : 1);
  return factors;
}

/// Adds a field without energy that stays within the tolerance to the null element, if there is one.
bool find_null_element(const Rectangle& region, const FlowOptions& options, FlowData& data) {
  const FitData& d = data.rows;
  const double radius = options.smoothing.value / d.scale;
  Eigen::MatrixXd rows = null_measurements(data, region, options);
  std::vector<double> centre, lower, upper;
  double square = 0;  // of the least squares over the radius
  for (std::size_t i = 0; i < d.size(); ++i) {
    const double factor = d.kind[i] == Measured::SlopeX ? data.stretch[i] : 1;
    centre.push_back(d.value[i] / factor);
    lower.push_back(centre.back() - radius);
    upper.push_back(centre.back() + radius);
    rows.row(static_cast<Eigen::Index>(i)) /= factor;
    square += 2 * d.weight[i] * d.value[i] * d.value[i];
  }
  const bool is_ball = options.tolerance_norm == ToleranceNorm::Euclidean;
  if (rows.cols() == 0 || square > (is_ball ? 1 : 2) * radius * radius) return false;
  std::unique_ptr<FeasibleSet> set;
  if (is_ball)
    set = std::make_unique<Balls>(centre, std::vector<double>(centre.size() / 2, radius), Balls::Options{2});
  else
    set = std::make_unique<Boxes>(lower, upper, std::vector<double>(centre.size(), radius));
  if (set->violation(std::vector<double>(centre.size())) <= 0) return true;
  const auto element = element_within(rows, *set);
  if (element) add_to_null_element(*element, region, options, data);
  return element.has_value();
}

}  // namespace

ScaledFit fit_flow_within(PenalisedProblem& problem, FlowData& data, const FlowOptions& flow, const FitOptions& options,
                          FlowResult& result) {
  if (find_null_element(problem.region(), flow, data)) {
    result.constraints.emplace();
    return {std::vector<double>(problem.unknowns()), 0, 0, 0};
  }
  const double radius = flow.smoothing.value / data.rows.scale;
  auto tolerances = factors_of(problem, data);
  ConstrainedFit found;
  if (flow.tolerance_norm == ToleranceNorm::Euclidean) {
    found = fit_within_balls(problem, radius, tolerances, options);
  } else {
    for (double& t : tolerances) t *= radius;
    found = fit_within(problem, tolerances, options);
  }
  result.constraints = found.account;
  if (found.growth) result.constraints->least_tolerance = *found.growth * flow.smoothing.value;
  return found;
}

void judge_tolerance(const VectorObservations& o, const FlowOptions& options, FlowResult& result) {
  constexpr double rounding = 1e-9;
  double worst = 0;
  for (std::size_t i = 0; i < o.size(); ++i) {
    if (std::isnan(result.fitted_u[i]) || (!o.weight.empty() && o.weight[i] == 0)) continue;
    const double u = std::abs(result.fitted_u[i] - o.u[i]), v = std::abs(result.fitted_v[i] - o.v[i]);
    const double away = options.tolerance_norm == ToleranceNorm::Euclidean ? std::hypot(u, v) : std::max(u, v);
    worst = std::max(worst, away);
  }
  worst /= options.smoothing.value;
  result.tolerance_reached = worst <= 1 + rounding;
  result.constraints->largest_violation = std::max(0., worst - 1);
}

void check_contradictions(const VectorObservations& o, const FlowData& data, const FlowOptions& options) {
  const double twice = 2 * options.smoothing.value;
  const auto name = [&](std::size_t i) {
    return options.name_of ? options.name_of(i) : "observation " + std::to_string(i + 1);
  };
  std::map<std::pair<double, double>, std::array<std::size_t, 4>> extremes;  // least and largest u, then v
  for (std::size_t row = 0; row < data.rows.size(); row += 2) {
    const std::size_t i = data.rows.source[row];
    auto& at = extremes.try_emplace({o.x[i], o.y[i]}, std::array{i, i, i, i}).first->second;
    if (o.u[i] < o.u[at[0]]) at[0] = i;
    if (o.u[i] > o.u[at[1]]) at[1] = i;
    if (o.v[i] < o.v[at[2]]) at[2] = i;
    if (o.v[i] > o.v[at[3]]) at[3] = i;
    for (const auto& [low, high, apart] :
         {std::tuple(at[0], at[1], o.u[at[1]] - o.u[at[0]]), std::tuple(at[2], at[3], o.v[at[3]] - o.v[at[2]])})
      if (apart > twice)
        throw InvalidInput("fit_flow: expected vectors at one place within their tolerances of each other, found (" +
                           number_text(o.u[low], 6) + ", " + number_text(o.v[low], 6) + ") (" + name(low) + ") and (" +
                           number_text(o.u[high], 6) + ", " + number_text(o.v[high], 6) + ") (" + name(high) +
                           ") at (" + number_text(o.x[i], 6) + ", " + number_text(o.y[i], 6) + ")");
  }
}

}  // namespace batten
