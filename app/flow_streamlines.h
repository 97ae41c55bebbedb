// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/flow_arguments.h>
#include <batten/domains/curve_samples.h>
#include <batten/domains/grid_samples.h>
#include <batten/flows/flow_field.h>

#include <cstddef>
#include <vector>

namespace batten {

/// Where streamlines shall pass; the lines of the file are those of messages.
struct FlowSeeds {
  std::vector<double> x, y;
  std::vector<std::size_t> lines;
};

/// The points of --seeds, none if there is no such option. Throws IoError or InvalidInput as tables do, and
/// InvalidInput for the first that lies outside the region.
FlowSeeds read_seeds(const FlowArguments& arguments, const Rectangle& region);

/// The streamlines that --streamlines or --seeds ask for, with speed, time, length and vorticity.
std::vector<CurveSamples> streamlines_of(const FlowArguments& arguments, const FlowSeeds& seeds,
                                         const FlowField& field);

}  // namespace batten
