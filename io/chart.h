// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/curve_samples.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace batten {

/// A curve in the plane and how it is drawn; its z is not looked at. A NaN in y interrupts the line.
struct ChartLine {
  enum class Style { Line, Dots, LineAndDots };
  CurveSamples curve;  ///< its name stands in the legend, if it has one
  Style style = Style::Line;
};

struct ChartOptions {
  int width = 1200;  ///< pixels, at least 200
  int height = 900;
  std::string title;
  std::string x_name = "x", y_name = "y";
  bool equal_scale = false;  ///< one unit of x as long as one unit of y: for curves in the plane
};

/// An image of lines over axes. Pixels are counted from the upper left corner.
struct Chart {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;                         ///< row by row from the top, three bytes per pixel
  std::array<double, 4> range = {0, 0, 0, 0};            ///< xmin, xmax, ymin, ymax of the axes
  std::array<double, 4> plot = {0, 0, 0, 0};             ///< left, right, top, bottom of the frame in pixels
  std::vector<std::array<std::uint8_t, 3>> line_colour;  ///< of each line
};

/// Draws lines in colours that colour-blind eyes tell apart [Okabe & Ito 2008], axes that span them, and a legend.
/// Throws InvalidInput if nothing finite is to be drawn, x and y differ in length or a size is out of range, IoError if
/// no off-screen context can be had.
Chart draw_chart(std::span<const ChartLine> lines, const ChartOptions& options);

/// Draws into a PNG file. Throws as above, and IoError if the file cannot be written.
void write_chart(const std::filesystem::path& path, std::span<const ChartLine> lines, const ChartOptions& options);

}  // namespace batten
