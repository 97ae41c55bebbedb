// SPDX-License-Identifier: MIT
#include <batten/bench/support/test_surface.h>

#include <cmath>

namespace batten {

double franke(double x, double y) {
  const auto square = [](double v) { return v * v; };
  return 0.75 * std::exp(-(square(9 * x - 2) + square(9 * y - 2)) / 4) +
         0.75 * std::exp(-square(9 * x + 1) / 49 - (9 * y + 1) / 10) +
         0.5 * std::exp(-(square(9 * x - 7) + square(9 * y - 3)) / 4) -
         0.2 * std::exp(-square(9 * x - 4) - square(9 * y - 7));
}

Observations random_observations(std::size_t count) {
  RandomPoints points;
  Observations o;
  for (std::size_t i = 0; i < count; ++i) {
    const auto [x, y] = points.next();
    o.x.push_back(x);
    o.y.push_back(y);
    o.value.push_back(franke(x, y));
  }
  return o;
}

Rectangle unit_square(int nx, int ny) { return {Interval(0, 1, nx), Interval(0, 1, ny)}; }

}  // namespace batten
