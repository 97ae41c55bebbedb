// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/balls.h>
#include <batten/fem/boxes.h>
#include <batten/fem/curve_energy.h>
#include <batten/fem/curve_within.h>
#include <batten/fem/interior_point.h>
#include <batten/fem/line_within.h>
#include <batten/fem/normalised_curve.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace batten {
namespace {

constexpr double least_energy = 1e-8;
constexpr int most_steps = 58;  // a factorisation each, and one or two for the start

void check(const std::vector<double>& knots, const Eigen::MatrixXd& points, std::span<const double> tolerances,
           bool closed) {
  NaturalCubic::require(knots, points, closed);
  if (points.cols() < 1 || points.cols() > 3)
    throw InvalidInput("curve_within: points of dimension 1 to 3 are expected, found " + std::to_string(points.cols()));
  if (static_cast<Eigen::Index>(tolerances.size()) != points.rows())
    throw InvalidInput("curve_within: one tolerance for each of " + std::to_string(points.rows()) +
                       " points is needed, found " + std::to_string(tolerances.size()));
  for (std::size_t i = 0; i < tolerances.size(); ++i)
    if (!(tolerances[i] > 0) || !std::isfinite(tolerances[i]))
      throw InvalidInput("curve_within: tolerances must be positive, found " + std::to_string(tolerances[i]) +
                         " at place " + std::to_string(i));
}

double length(std::span<const double> v) {
  double square = 0;
  for (const double x : v) square += x * x;
  return std::sqrt(square);
}

/// Distance of each value from its point, over the radius.
std::vector<double> misses(const std::vector<double>& values, const NormalisedCurve& data,
                           const std::vector<double>& radius) {
  const auto dimension = static_cast<std::size_t>(data.dimension);
  std::vector<double> result, away(values.size());
  for (std::size_t row = 0; row < values.size(); ++row) away[row] = values[row] - data.points[row];
  for (std::size_t i = 0; i < radius.size(); ++i)
    result.push_back(length(std::span(away).subspan(i * dimension, dimension)) / radius[i]);
  return result;
}

int number_held(const std::vector<double>& misses, std::span<const double> force) {
  const std::size_t dimension = force.size() / misses.size();
  std::vector<double> forces;
  for (std::size_t i = 0; i < misses.size(); ++i) forces.push_back(length(force.subspan(i * dimension, dimension)));
  const double largest = *std::max_element(forces.begin(), forces.end());
  int count = 0;
  for (std::size_t i = 0; i < misses.size(); ++i) count += (1 - misses[i]) * largest < forces[i];
  return count;
}

CurveAccount account_of(const InteriorPointResult& result, const CurveEnergy& energy, const NormalisedCurve& data,
                        const std::vector<double>& radius) {
  const auto away = misses(energy.values(), data, radius);
  CurveAccount account;
  account.energy = data.energy_of(result.energy) * data.range * data.range;
  account.energy_gap = std::max(0., result.gap);
  account.largest_violation = std::max(0., *std::max_element(away.begin(), away.end()) - 1);
  if (!result.force.empty()) account.active = number_held(away, result.force);
  account.factorisations = energy.factorisations();
  return account;
}

/// The points of a line at places.
std::vector<double> on_line(const std::vector<double>& line, const NormalisedCurve& data) {
  const auto dimension = static_cast<std::size_t>(data.dimension);
  std::vector<double> result;
  for (const double t : data.places)
    for (std::size_t k = 0; k < dimension; ++k) result.push_back(line[k] + t * line[dimension + k]);
  return result;
}

/// Numbers have boxes, which are the same with less work.
std::unique_ptr<FeasibleSet> set_within(const NormalisedCurve& data, const std::vector<double>& radius) {
  if (data.dimension > 1) return std::make_unique<Balls>(data.points, radius, Balls::Options{data.dimension});
  std::vector<double> lower, upper;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    lower.push_back(data.points[i] - radius[i]);
    upper.push_back(data.points[i] + radius[i]);
  }
  return std::make_unique<Boxes>(lower, upper, radius);
}

/// What is known of the energy where it is, by the forces that hold it there.
InteriorPointResult hold(CurveEnergy& energy, const FeasibleSet& set, double least) {
  InteriorPointResult result;
  result.energy = energy.energy();
  result.force.resize(energy.rows());
  const double bound = energy.bound(result.force);
  result.gap = (result.energy - bound + set.gain(result.force)) / std::max(result.energy, least);
  return result;
}

NaturalCubic curve_of(std::vector<double> knots, const NormalisedCurve& data, const std::vector<double>& values,
                      const std::vector<double>& bends, bool closed) {
  return NaturalCubic::from_values(std::move(knots), data.values(values), data.second_derivatives(bends), closed);
}

}  // namespace

CurveWithin least_curve_within(std::vector<double> knots, const Eigen::MatrixXd& points,
                               std::span<const double> tolerances, const CurveWithinOptions& options) {
  check(knots, points, tolerances, options.closed);
  using Less = NormalisedCurve::Less;
  const NormalisedCurve data(knots, points, options.closed ? Less::Mean : Less::Line);
  std::vector<double> radius;
  for (const double tolerance : tolerances) radius.push_back(tolerance / data.range);
  if (const auto line = line_within({data.dimension, data.places, data.points, radius, options.closed}))
    return {
        curve_of(std::move(knots), data, on_line(*line, data), std::vector<double>(data.points.size()), options.closed),
        {}};
  const CurveEnergy::Strip strip{data.widths, data.dimension, options.closed, std::vector<double>(radius.size()),
                                 std::vector<double>(data.points.size())};
  CurveEnergy energy(strip, data.points);
  const auto set = set_within(data, radius);
  set->start(energy.values(), energy.energy() / set->count());
  InteriorPointOptions steps;
  steps.gap = options.gap;
  steps.least_energy = data.normalised_energy(least_energy);
  steps.most_steps = most_steps;
  steps.progress = options.progress;
  InteriorPointResult result = minimise(energy, *set, steps);
  CurveAccount account = account_of(result, energy, data, radius);
  if (account.largest_violation > 0) {
    energy = CurveEnergy(strip, data.points);
    result = hold(energy, *set, steps.least_energy);
    account = account_of(result, energy, data, radius);
  }
  return {curve_of(std::move(knots), data, energy.values(), energy.second_derivatives(), options.closed), account};
}

}  // namespace batten
