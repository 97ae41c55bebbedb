// SPDX-License-Identifier: MIT
#include <batten/io/colour_map.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

// Twelve equidistant colours of the map as published (CC0), rounded to bytes.
constexpr std::array<std::array<std::uint8_t, 3>, 12> control_colours = {{{0x44, 0x01, 0x54},
                                                                          {0x48, 0x21, 0x73},
                                                                          {0x43, 0x3E, 0x85},
                                                                          {0x38, 0x59, 0x8C},
                                                                          {0x2D, 0x70, 0x8E},
                                                                          {0x25, 0x85, 0x8E},
                                                                          {0x1E, 0x9B, 0x8A},
                                                                          {0x2B, 0xB0, 0x7F},
                                                                          {0x51, 0xC5, 0x6A},
                                                                          {0x85, 0xD5, 0x4A},
                                                                          {0xC2, 0xDF, 0x23},
                                                                          {0xFD, 0xE7, 0x25}}};

}  // namespace

std::array<std::uint8_t, 3> viridis(double t) {
  constexpr std::size_t intervals = control_colours.size() - 1;
  const double position = std::clamp(t, 0.0, 1.0) * intervals;
  const std::size_t k = std::min(static_cast<std::size_t>(position), intervals - 1);
  const double fraction = position - static_cast<double>(k);
  std::array<std::uint8_t, 3> colour = {};
  for (std::size_t c = 0; c < colour.size(); ++c) {
    const double mixed = (1 - fraction) * control_colours[k][c] + fraction * control_colours[k + 1][c];
    colour[c] = static_cast<std::uint8_t>(std::lround(mixed));
  }
  return colour;
}

}  // namespace batten
