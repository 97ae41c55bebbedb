// SPDX-License-Identifier: MIT
#pragma once

#include <batten/flows/flow_field.h>

#include <cstdint>

namespace batten {

/// Largest |u_x + v_y| (on a sphere |u_x + v_y - v tan(y) / R|) over largest |∇v|, both by central differences of
/// evaluated velocities over a thousandth of a cell, at 2000 random points; 0 for a field whose gradient vanishes
/// there.
double divergence_share(const FlowField& field, std::uint64_t seed = 1);

}  // namespace batten
