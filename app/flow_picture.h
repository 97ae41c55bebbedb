// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/curve_samples.h>
#include <batten/domains/grid_samples.h>
#include <batten/io/picture.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace batten {

/// A map of the array "speed" under streamlines or arrows.
struct FlowPicture {
  std::string path, title;
  std::array<std::string, 2> names = {"x", "y"};  ///< at the axes
  double y_scale = 1;                             ///< of PictureOptions
  std::optional<std::array<int, 2>> pixels;       ///< width and height; those of PictureOptions if there are none
  std::vector<CurveSamples> curves;
  PictureOptions::Heads heads = PictureOptions::Heads::End;  ///< those of arrows
};
void draw_flow_picture(const FlowPicture& picture, const GridSamples& samples);

}  // namespace batten
