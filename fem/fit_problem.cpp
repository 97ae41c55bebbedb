// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/fit_problem.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>

namespace batten {
namespace {

void check(const Observations& o) {
  if (o.y.size() != o.size() || o.value.size() != o.size() || (!o.weight.empty() && o.weight.size() != o.size()))
    throw InvalidInput("fit_surface: expected x, y, value and weight of one length, found " +
                       std::to_string(o.x.size()) + ", " + std::to_string(o.y.size()) + ", " +
                       std::to_string(o.value.size()) + " and " + std::to_string(o.weight.size()));
  for (std::size_t i = 0; i < o.size(); ++i) {
    if (!std::isfinite(o.x[i]) || !std::isfinite(o.y[i]) || !std::isfinite(o.value[i]))
      throw InvalidInput("fit_surface: expected finite numbers, found (" + number_text(o.x[i], 10) + ", " +
                         number_text(o.y[i], 10) + ") with value " + number_text(o.value[i], 10) + " at observation " +
                         std::to_string(i + 1));
    if (!o.weight.empty() && !(o.weight[i] >= 0 && std::isfinite(o.weight[i])))
      throw InvalidInput("fit_surface: expected weights that are not negative, found " + number_text(o.weight[i], 10) +
                         " at observation " + std::to_string(i + 1));
  }
  if (!o.weight.empty() && std::all_of(o.weight.begin(), o.weight.end(), [](double w) { return w == 0; }))
    throw InvalidInput("fit_surface: expected a weight that is not zero, found all " + std::to_string(o.size()) +
                       " zero");
}

/// Observations at the same place become one: mean value, summed weight. Returns how many vanished.
std::size_t merge(FitData& d) {
  std::vector<std::size_t> order(d.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::tie(d.x[a], d.y[a], a) < std::tie(d.x[b], d.y[b], b); });
  std::vector<bool> keep(d.size(), true);
  std::size_t vanished = 0;
  for (std::size_t i = 0, next = 0; i < order.size(); i = next) {
    const std::size_t first = order[i];
    double sum = 0, weight = 0;
    for (next = i; next < order.size() && d.x[order[next]] == d.x[first] && d.y[order[next]] == d.y[first]; ++next) {
      const std::size_t k = order[next];
      sum += d.weight[k] * d.value[k];
      weight += d.weight[k];
      keep[k] = k == first;
    }
    vanished += next - i - 1;
    if (next - i > 1) d.value[first] = sum / weight;
    d.weight[first] = weight;
  }
  if (vanished == 0) return 0;
  std::size_t to = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    d.x[to] = d.x[i];
    d.y[to] = d.y[i];
    d.value[to] = d.value[i];
    d.weight[to] = d.weight[i];
    d.source[to++] = d.source[i];
  }
  for (auto* column : {&d.x, &d.y, &d.value, &d.weight}) column->resize(to);
  d.source.resize(to);
  return vanished;
}

void check_determined(const FitData& d, const Energy& energy, const Rectangle& region, std::size_t observations) {
  if (d.size() == 0)
    throw InvalidInput("fit_surface: expected at least one point inside the region, found none of " +
                       std::to_string(observations) + " in x from " + number_text(region.x.lower(), 10) + " to " +
                       number_text(region.x.upper(), 10) + ", y from " + number_text(region.y.lower(), 10) + " to " +
                       number_text(region.y.upper(), 10));
  if (energy.null_degree() == 0) return;
  // In units of the region's sides, so that the answer does not depend on the units of x and y.
  std::vector<double> s(d.size()), t(d.size());
  for (std::size_t i = 0; i < d.size(); ++i) {
    s[i] = (d.x[i] - region.x.lower()) / region.x.length();
    t[i] = (d.y[i] - region.y.lower()) / region.y.length();
  }
  if (flatness(s, t) < 1e-10)
    throw InvalidInput("fit_surface: the thin plate needs three points that are not on one line, found " +
                       std::to_string(d.size()) + (d.size() == 1 ? " point" : " points on one line") +
                       " (membrane and tension need one point)");
}

/// Subtracts the null element and divides by the range, so that the solver sees numbers of order 1 without offset or
/// slope.
void normalise(FitData& d, const Energy& energy) {
  d.total_weight = std::accumulate(d.weight.begin(), d.weight.end(), 0.);
  for (double& w : d.weight) w /= d.total_weight;
  const auto [lowest, highest] = std::minmax_element(d.value.begin(), d.value.end());
  const double low = *lowest, high = *highest, range = high - low;
  d.null_element = fit_null_space(energy.null_degree(), d.x, d.y, d.value, d.weight);
  d.scale = range > 0 ? range : 1;
  const double rounding =
      16 * std::numeric_limits<double>::epsilon() * std::max(std::abs(low), std::abs(high)) / d.scale;
  double largest = 0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    d.value[i] = (d.value[i] - d.null_element(d.x[i], d.y[i])) / d.scale;
    largest = std::max(largest, std::abs(d.value[i]));
  }
  if (largest <= rounding)
    std::fill(d.value.begin(), d.value.end(), 0.);  // data of the null space leave nothing to fit
}

}  // namespace

PreparedData prepare(const Observations& o, const Rectangle& region, const Energy& energy, bool merge_coincident) {
  check(o);
  PreparedData result;
  FitData& d = result.data;
  for (std::size_t i = 0; i < o.size(); ++i) {
    const double weight = o.weight.empty() ? 1 : o.weight[i];
    if (!region.contains(o.x[i], o.y[i])) ++result.outside;
    if (!region.contains(o.x[i], o.y[i]) || weight == 0) continue;
    d.x.push_back(o.x[i]);
    d.y.push_back(o.y[i]);
    d.value.push_back(o.value[i]);
    d.weight.push_back(weight);
    d.source.push_back(i);
  }
  if (merge_coincident) result.merged = merge(d);
  check_determined(d, energy, region, o.size());
  normalise(d, energy);
  return result;
}

namespace {

GridPoints to_cells(const FitData& d, const Hierarchy& hierarchy) {
  GridPoints points;
  const auto& space = hierarchy.finest().space;
  points.x.reserve(d.size());
  points.y.reserve(d.size());
  for (std::size_t i = 0; i < d.size(); ++i) {
    points.x.push_back(space.x.interval().to_cells(d.x[i]));
    points.y.push_back(space.y.interval().to_cells(d.y[i]));
  }
  points.kind = d.kind;
  points.spacing = d.spacing;
  return points;
}

GridPoints in_order(const GridPoints& p, const std::vector<std::size_t>& order) {
  return {reordered(p.x, order), reordered(p.y, order), p.kind.empty() ? p.kind : reordered(p.kind, order), p.spacing};
}

}  // namespace

FitProblem::FitProblem(const FitData& data, const Rectangle& region, const FitOptions& options, const SpaceEnds& ends)
    : data_(data),
      options_(options),
      ends_(ends),
      hierarchy_(options.energy, region, options.degree, {options.aspect}, ends),
      points_(to_cells(data, hierarchy_)),
      order_(cell_order(points_, hierarchy_.finest().space)),
      system_((points_ = in_order(points_, order_), hierarchy_), points_) {
  value_ = reordered(data.value, order_);
  weight_ = reordered(data.weight, order_);
}

SplineSpace FitProblem::whole_space() const {
  const SplineSpace& space = hierarchy_.finest().space;
  return {space.x.unconstrained(), space.y.unconstrained(), space.hx, space.hy};
}

std::vector<double> FitProblem::right_side(std::span<const double> weights, std::span<const double> values) const {
  std::vector<double> weighted(size()), b(system_.size());
  for (std::size_t i = 0; i < size(); ++i) weighted[i] = weights[i] * values[i];
  system_.data().add_adjoint(weighted, b);
  return b;
}

std::vector<double> FitProblem::values(std::span<const double> c) const {
  std::vector<double> result(size());
  system_.data().values(c, result);
  return result;
}

std::vector<double> FitProblem::whole(std::span<const double> c) const {
  std::vector<double> result(c.begin(), c.end());
  to_unconstrained(hierarchy_.finest().space, result);
  return result;
}

std::unique_ptr<PenalisedProblem> FitProblem::on(const Rectangle& grid) const {
  return std::make_unique<FitProblem>(data_, grid, options_, ends_);
}

ScaledFit solve_fixed(PenalisedProblem& problem, double lambda, const FitOptions& options, std::vector<double> start) {
  start.resize(problem.unknowns());
  ScaledFit fit{std::move(start), lambda, 0, 0};
  problem.set(lambda);
  const auto b = problem.right_side(problem.weight(), problem.value());
  if (options.progress) options.progress("solve", 0);
  const auto result = problem.solve(b, fit.coefficients, options.limits, 0);
  fit.iterations = result.iterations;
  fit.accuracy = result.accuracy;
  return fit;
}

}  // namespace batten
