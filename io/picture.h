// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/curve_samples.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace batten {

/// Texts may have the letters of Latin-1 (in UTF-8); others, such as Greek ones, are left out.
struct PictureOptions {
  enum class View {
    Map,      ///< seen from above: colours and contour lines
    Surface,  ///< a shaded, coloured surface over the plane
  };
  View view = View::Surface;
  int width = 1200;  ///< pixels, at least 200
  int height = 900;
  std::string array = "value";       ///< the one-component array of the grid that is shown
  std::string title;                 ///< above the picture; may be empty
  std::string value_name = "value";  ///< at the colour bar
  std::string x_name = "x";
  std::string y_name = "y";
  double y_scale = 1;                ///< length of one unit of y in the picture, in units of x
  std::optional<double> bold_value;  ///< Map: the contour line of this value is drawn bold
  bool contours = true;              ///< Map: contour lines of round values
  enum class Heads {
    Along,  ///< arrow heads at equal distances, one at least
    End,    ///< one at the end: the curves are arrows
  };
  std::vector<CurveSamples> curves;  ///< Map: white lines with dark edges over the colours, at their x and y
  Heads heads = Heads::Along;        ///< of the curves, in the order of their points
  double relief = 1 / 3.;            ///< Surface: height of the surface over the longer side of its plan
};

/// An image and what it shows where. Pixels are counted from the upper left corner.
struct Picture {
  struct Box {
    int left = 0, top = 0, right = 0, bottom = 0;  ///< right and bottom are exclusive
  };
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< row by row from the top, three bytes per pixel
  Box plot;                       ///< Map: the grid's rectangle; Surface: the part of the image that the scene has
  Box colour_bar;                 ///< its colours alone
  std::array<double, 2> range = {0, 0};  ///< values at the bottom and top of the colour bar: the extremes of the grid
  std::vector<std::string> bar_labels;   ///< from bottom to top; the first and the last stand at the ends
};

/// Draws a grid and data points, without a display. Blank (NaN) grid values stay empty. The points lie at their (x, y),
/// in the surface view at height z; of more than 6000 points an even selection is drawn. A grid of more than 1000
/// points along a side is thinned. The background is white.
/// Throws InvalidInput if the array is missing or has no finite value or an option is out of range, IoError if no
/// off-screen context can be had.
Picture draw_picture(const GridSamples& grid, const ScatteredSamples& points, const PictureOptions& options);

/// Draws into a PNG file. Throws as above, and IoError if the file cannot be written.
void write_picture(const std::filesystem::path& path, const GridSamples& grid, const ScatteredSamples& points,
                   const PictureOptions& options);

}  // namespace batten
