// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace batten {

/// Balls that a line c(t) = c_0 + c_1 t has to meet at their places.
struct LineGoals {
  int dimension = 1;               ///< 1 to 3
  std::span<const double> places;  ///< from -1 to 1
  std::span<const double> centre;  ///< `dimension` numbers for each
  std::span<const double> radius;  ///< positive
  bool is_constant = false;        ///< c_1 = 0
};

/// (c_0; c_1), `dimension` numbers each, of a line within all balls: 0 where that one is, otherwise one that is about
/// as far inside as it can be. None where there is none, or by less than 1e-5 of the radii.
std::optional<std::vector<double>> line_within(const LineGoals& goals);

}  // namespace batten
