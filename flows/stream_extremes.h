// SPDX-License-Identifier: MIT
#pragma once

#include <batten/flows/flow_field.h>

namespace batten {

/// Where ψ is least and largest. Inside these are centres about which the flow turns: clockwise about the least, where
/// ψ grows outwards, and counterclockwise about the largest; on a sphere, where ψ has the other sign, conversely.
struct StreamExtremes {
  struct Place {
    double value = 0, x = 0, y = 0;
  };
  Place least, largest;
};

/// Those of the corners of the cells, moved by Newton's method to where the velocity vanishes if it does so near them.
/// Throws InvalidInput if there is no ψ.
StreamExtremes stream_extremes(const FlowField& field);

}  // namespace batten
