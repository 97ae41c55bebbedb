// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/interval.h>

namespace batten {

/// A rectangle cut into a grid of cells: the product of two intervals.
struct Rectangle {
  Interval x, y;

  /// True for points inside and on the border; false for NaN.
  bool contains(double px, double py) const {
    return px >= x.lower() && px <= x.upper() && py >= y.lower() && py <= y.upper();
  }
};

}  // namespace batten
