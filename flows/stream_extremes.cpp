// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/flows/stream_extremes.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

/// The point at rest that Newton's method finds within two cells of `start`, if ψ is farther out there; else `start`.
StreamExtremes::Place refined(const FlowField& field, const StreamExtremes::Place& start, double sign) {
  constexpr int most_steps = 20;
  constexpr double farthest = 2;  // cells
  const double hx = field.region().x.finest_cell_length(), hy = field.region().y.finest_cell_length();
  StreamExtremes::Place at = start;
  for (int k = 0; k < most_steps; ++k) {
    const auto [u, v] = field.velocity(at.x, at.y);
    const auto g = field.gradient(at.x, at.y);
    const double determinant = g.u_x * g.v_y - g.u_y * g.v_x;
    const double dx = (g.u_y * v - g.v_y * u) / determinant, dy = (g.v_x * u - g.u_x * v) / determinant;
    at.x += dx / field.geometry().length_x(at.y);
    at.y += dy / field.geometry().length_y();
    const bool near = std::abs(at.x - start.x) <= farthest * hx && std::abs(at.y - start.y) <= farthest * hy;
    if (!near || !field.region().contains(at.x, at.y)) return start;
  }
  at.value = field.stream_function(at.x, at.y);
  return sign * (at.value - start.value) > 0 ? at : start;
}

}  // namespace

StreamExtremes stream_extremes(const FlowField& field) {
  if (!field.stream()) throw InvalidInput("stream_extremes: expected a field with a stream function, found none");
  const GridSamples grid = field.stream()->samples();
  std::vector<double> psi = grid.arrays.front().values;
  if (field.geometry().is_sphere())
    for (double& v : psi) v = -v;
  const auto [least, largest] = std::ranges::minmax(psi);
  const double rounding = 1e-13 * (largest - least);
  const auto place = [&](double extreme) {  // the first of those along a wall
    const auto found = std::ranges::find_if(psi, [&](double v) { return std::abs(v - extreme) <= rounding; });
    const auto k = static_cast<int>(found - psi.begin());
    return StreamExtremes::Place{*found, field.region().x.coordinate(k % grid.points[0]),
                                 field.region().y.coordinate(k / grid.points[0])};
  };
  return {refined(field, place(least), -1), refined(field, place(largest), 1)};
}

}  // namespace batten
