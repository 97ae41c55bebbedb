// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

namespace batten {

/// A named array of values at points or in cells, `components` numbers for each, interleaved. Blank values are NaN.
struct PointArray {
  std::string name;
  int components = 1;
  std::vector<double> values;
};

/// Values sampled on a uniform grid of points: point (i, j) lies at origin + (i, j) * spacing and has index i + j *
/// points[0].
struct GridSamples {
  std::array<int, 2> points = {0, 0};
  std::array<double, 2> origin = {0, 0};
  std::array<double, 2> spacing = {1, 1};
  std::vector<PointArray> arrays;
  std::vector<PointArray> cell_arrays;  ///< of the (points[0] - 1) x (points[1] - 1) cells between, x fastest
};

/// Values at scattered points (x[i], y[i], z[i]).
struct ScatteredSamples {
  std::vector<double> x, y, z;
  std::vector<PointArray> arrays;
};

}  // namespace batten
