// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <string>

class vtkRenderer;

namespace batten {

/// A place in the window in pixels, counted from the lower left corner to the right and upwards.
using Pixel = std::array<double, 2>;

struct TextStyle {
  enum class Anchor { Low, Centre, High };  ///< which part of the text stands at its place: left or bottom, ...
  Anchor horizontal = Anchor::Centre;
  Anchor vertical = Anchor::Centre;
  double size = 1;       ///< times the overlay's font size
  bool upwards = false;  ///< turned by 90 degrees
  bool bold = false;
};

struct PenStyle {
  double width = 1;                                ///< pixels
  std::array<double, 3> colour = {0.1, 0.1, 0.1};  ///< red, green, blue in [0, 1]
};

/// Draws text, lines and areas over the scene of a renderer.
class PlotOverlay {
public:
  PlotOverlay(vtkRenderer* renderer, double font_size);

  double font_size() const { return font_size_; }

  /// Width and height in pixels.
  std::array<double, 2> text_size(const std::string& text, const TextStyle& style = {}) const;

  /// The style with its size made smaller, if it must be, for the text to be at most `length` pixels long.
  TextStyle fitted(const std::string& text, TextStyle style, double length) const;

  void add_text(const std::string& text, const Pixel& place, const TextStyle& style);

  /// A line through the places.
  void add_line(std::span<const Pixel> places, const PenStyle& style);
  /// A dot of the style's width at each place.
  void add_dots(std::span<const Pixel> places, const PenStyle& style);

  /// The colour map, lowest colour at the bottom, in the rectangle from `low` to `high`.
  void add_colour_bar(const Pixel& low, const Pixel& high);

private:
  vtkRenderer* renderer_;
  double font_size_;
};

}  // namespace batten
