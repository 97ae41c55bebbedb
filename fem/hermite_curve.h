// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace batten {

/// A piecewise cubic function with these values and slopes at increasing knots.
struct HermiteCurve {
  std::vector<double> knots, values, slopes;

  /// At t between the first and the last knot.
  double value(double t) const;
};

/// v_0 + s x + g_0 x² / 2 + (g_1 - g_0) x³ / (6 h) for x from 0 to h, by its values and second derivatives at the ends.
struct CubicCell {
  double width, left, right, bend_left, bend_right;

  double slope_left() const { return (right - left) / width - width * (2 * bend_left + bend_right) / 6; }
  double slope_right() const { return (right - left) / width + width * (bend_left + 2 * bend_right) / 6; }
  double value(double x) const;
  /// Where it is least.
  double lowest() const;
};

}  // namespace batten
