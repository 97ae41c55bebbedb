// SPDX-License-Identifier: MIT
#include <batten/bases/gauss_rule.h>
#include <batten/flows/mean_velocity.h>

namespace batten {
namespace {

/// The mean of f over an interval, by Gauss points in each cell: exact for splines up to degree 7.
template <typename F>
double mean_over(const Interval& interval, F&& f) {
  const GaussRule rule = gauss_rule(4);
  const double h = interval.length() / interval.cells();
  double sum = 0;
  for (int cell = 0; cell < interval.cells(); ++cell)
    for (std::size_t k = 0; k < rule.place.size(); ++k)
      sum += rule.weight[k] * f(interval.lower() + h * (cell + rule.place[k]));
  return sum / interval.cells();
}

}  // namespace

FlowField::Velocity mean_velocity(const FlowField& field) {
  const auto& [x, y] = field.region();
  const FlowGeometry& geometry = field.geometry();
  // The mean slopes to the east, where parallels differ in length, and to the north.
  const auto east = [&](const Solution& p) {
    return mean_over(y, [&](double t) {
      return (p.value(x.upper(), t) - p.value(x.lower(), t)) / (x.length() * geometry.length_x(t));
    });
  };
  const auto north = [&](const Solution& p) {
    return mean_over(x, [&](double s) { return p.value(s, y.upper()) - p.value(s, y.lower()); }) /
           (y.length() * geometry.length_y());
  };
  FlowField::Velocity mean;
  if (field.stream()) mean = {north(*field.stream()), -east(*field.stream())};
  if (!field.potential()) return mean;
  return {mean.u + east(*field.potential()), mean.v + north(*field.potential())};
}

}  // namespace batten
