// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/curve_samples.h>
#include <batten/domains/grid_samples.h>
#include <batten/flows/flow_field.h>

#include <vector>

namespace batten {

// Arrows with their middles on an even grid, as long as the velocity is large, up to three times its root mean square;
// the longest nearly meet. Where the flow is slow, or not finite, there is none.

/// On a grid over the region.
std::vector<CurveSamples> arrows_of(const FlowField& field);

/// At the points of the grid but for the sides, or every second, third ... of them, from the array "velocity".
std::vector<CurveSamples> arrows_of(const GridSamples& samples);

}  // namespace batten
