// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/staggered_field.h>
#include <batten/domains/grid_samples.h>

namespace batten {

/// At the vertices of all but the outermost cells: velocity (3 components, the third 0), divergence (the mean of the
/// cells around), rotation, speed and stream_function; in their cells cell_divergence.
GridSamples samples_of(const StaggeredField& field);

/// velocity and speed of a grid with the components u and v.
GridSamples samples_of_velocity(const ControlGrid& velocity);

}  // namespace batten
