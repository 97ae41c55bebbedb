// SPDX-License-Identifier: MIT
#include <batten/app/mask.h>
#include <batten/domains/errors.h>
#include <batten/domains/nearest_point.h>
#include <batten/domains/number_text.h>

#include <algorithm>
#include <limits>

namespace batten {
namespace {

NearestPoint points_within(const Rectangle& region, const Observations& observations, double aspect) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (!region.contains(observations.x[i], observations.y[i])) continue;
    x.push_back(observations.x[i]);
    y.push_back(observations.y[i] * aspect);
  }
  return NearestPoint(x, y);
}

}  // namespace

std::vector<bool> far_corners(const Rectangle& region, const Observations& observations, double distance,
                              double aspect) {
  NearestPoint points = points_within(region, observations, aspect);
  const int columns = region.x.cells() + 1, rows = region.y.cells() + 1;
  std::vector<bool> far;
  far.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int j = 0; j < rows; ++j) {
    const double y = region.y.coordinate(j) * aspect;
    for (int i = 0; i < columns; ++i) far.push_back(points.distance(region.x.coordinate(i), y) > distance);
  }
  if (std::find(far.begin(), far.end(), false) != far.end()) return far;
  throw InvalidInput("--mask-distance: no corner of a cell lies within " + number_text(distance, 6) +
                     " of a point; choose a larger distance or smaller cells");
}

void blank(GridSamples& grid, const std::vector<bool>& far) {
  for (PointArray& array : grid.arrays) {
    const auto components = static_cast<std::size_t>(array.components);
    for (std::size_t k = 0; k < array.values.size(); ++k) {
      if (far[k / components]) array.values[k] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

}  // namespace batten
