// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/grid_samples.h>
#include <batten/domains/rectangle.h>
#include <batten/fem/fit.h>

#include <vector>

namespace batten {

/// For each corner of the cells (x fastest) whether it is farther than `distance` from every observation in the region;
/// distances are in units of x, one unit of y counting as `aspect` of them. Throws InvalidInput if all of them are, and
/// in builds without CGAL.
std::vector<bool> far_corners(const Rectangle& region, const Observations& observations, double distance,
                              double aspect);

/// Sets all arrays to NaN at the corners that `far` says.
void blank(GridSamples& grid, const std::vector<bool>& far);

}  // namespace batten
