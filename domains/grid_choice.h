// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/rectangle.h>

#include <array>
#include <optional>
#include <span>

namespace batten {

/// What the user says about the grid; the rest is chosen.
struct GridChoice {
  std::optional<std::array<double, 4>>
      region;  ///< xmin, xmax, ymin, ymax; else the bounding box widened by 5 % of its longer side
  std::optional<std::array<int, 2>> cells;  ///< honoured exactly; else ...
  std::optional<double>
      spacing;        ///< ... cells of this length in x (and spacing / aspect in y); else about 256 on the longer side
  double aspect = 1;  ///< one unit of y counts as this many units of x: cells are square in that measure
};

/// The rectangle for points (x[i], y[i]). Unless `cells` is given, the upper ends are moved outwards so that cells are
/// square and their numbers are multiples of 2^k with at most 8 cells on the longer side of the coarsest level. Throws
/// InvalidInput for regions of zero or negative size, fewer than 2 cells, a spacing or aspect that is not positive.
Rectangle choose_grid(std::span<const double> x, std::span<const double> y, const GridChoice& choice = {});

}  // namespace batten
