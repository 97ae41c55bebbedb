// SPDX-License-Identifier: MIT
#pragma once

#include <batten/flows/flow_field.h>

namespace batten {

/// The mean of v over the region, on a sphere over longitude and latitude. From ψ and φ on the sides alone.
FlowField::Velocity mean_velocity(const FlowField& field);

}  // namespace batten
