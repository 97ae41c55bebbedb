// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/grid_samples.h>

#include <string>
#include <vector>

namespace batten {

/// A polyline with values at its points (x[i], y[i], z[i]). A closed one also joins the last point to the first.
struct CurveSamples {
  std::string name;
  std::vector<double> x, y, z;
  bool closed = false;
  std::vector<PointArray> arrays;
};

}  // namespace batten
