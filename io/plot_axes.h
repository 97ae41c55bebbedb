// SPDX-License-Identifier: MIT
#pragma once

#include <batten/io/axis_ticks.h>
#include <batten/io/plot_overlay.h>

#include <array>
#include <string>
#include <vector>

namespace batten {

/// A rectangle of the window.
struct PlotArea {
  Pixel low = {0, 0};
  Pixel high = {0, 0};
  double width() const { return high[0] - low[0]; }
  double height() const { return high[1] - low[1]; }
};

/// What an axis shows.
struct AxisRange {
  double low = 0, high = 1;
  std::string name;
};

/// Pixels that tick marks, labels and the name take to the left of a plot and below it.
std::array<double, 2> axis_margins(const PlotOverlay& overlay, const AxisRange& y);

/// A frame around the plot, with tick marks, labels and names to the left and below.
void draw_axes(PlotOverlay& overlay, const PlotArea& plot, const AxisRange& x, const AxisRange& y);

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

}  // namespace batten
