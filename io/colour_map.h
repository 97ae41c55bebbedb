// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace batten {

/// The sRGB colour of level t in [0, 1] (clamped) of the colour map viridis, whose lightness grows evenly from dark
/// violet to yellow, also for colour-blind eyes and in grey print [van der Walt & Smith 2015].
std::array<std::uint8_t, 3> viridis(double t);

}  // namespace batten
