// SPDX-License-Identifier: MIT
#pragma once

#include <batten/io/axis_ticks.h>
#include <batten/io/picture.h>
#include <batten/io/picture_field.h>
#include <batten/io/plot_overlay.h>
#include <batten/io/scene_actors.h>

#include <span>
#include <vector>

namespace batten {

/// A rectangle of the window.
struct PlotArea {
  Pixel low = {0, 0};
  Pixel high = {0, 0};
  double width() const { return high[0] - low[0]; }
  double height() const { return high[1] - low[1]; }
};

/// What a view is made of, and where it may draw. Everything but `mesh` is set by the caller.
struct ViewInput {
  vtkRenderer* renderer = nullptr;
  PlotOverlay* overlay = nullptr;
  const PictureField* field = nullptr;
  std::span<const ScenePoint> points;  ///< in the data's units, within the field's rectangle
  std::span<const Tick> value_ticks;   ///< round values
  const PictureOptions* options = nullptr;
  PlotArea area;
  SceneMesh mesh;  ///< filled by the view; must live until the window has been drawn
};

/// Colours and contour lines seen from above; the rectangle that the field fills.
PlotArea draw_map(ViewInput& view);

/// The shaded surface in a box with labelled edges; the rectangle that the box fills.
PlotArea draw_surface(ViewInput& view);

/// As many round values as there is room for: at most `length` pixels for labels that are each `label_length(label)`
/// long.
template <class LabelLength>
requires requires(LabelLength measure, const std::string& label) { double{measure(label)}; }
std::vector<Tick> fitting_ticks(double low, double high, double length, const LabelLength& label_length) {
  constexpr int most = 9;
  constexpr double gap = 1.5;
  for (int count = most; count > 2; --count) {
    std::vector<Tick> ticks = nice_ticks(low, high, count);
    double total = 0;
    for (const Tick& tick : ticks) total += gap * label_length(tick.label);
    if (total <= length) return ticks;
  }
  return nice_ticks(low, high, 2);
}

/// The diameter in pixels of dots for `count` data points in a plot of `area` square pixels.
double dot_diameter(std::size_t count, double area);

}  // namespace batten
