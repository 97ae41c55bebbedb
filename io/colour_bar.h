// SPDX-License-Identifier: MIT
#pragma once

#include <batten/io/axis_ticks.h>
#include <batten/io/plot_overlay.h>

#include <string>
#include <vector>

namespace batten {

/// A vertical colour bar over the values from `low` to `high` with a label at each end and at round values between.
class ColourBar {
public:
  ColourBar(double low, double high, std::string name);

  /// The round values; contour lines are drawn there.
  const std::vector<Tick>& ticks() const { return ticks_; }

  /// Pixels that the bar takes from left to right, with its labels.
  double width(const PlotOverlay& overlay) const;

  /// Draws the bar from `low` (its lower left corner) up to the height `top`; the labels, from bottom to top.
  std::vector<std::string> draw(PlotOverlay& overlay, const Pixel& low, double top) const;

  /// Pixels that the colours alone are wide.
  static double colours_width(const PlotOverlay& overlay);

private:
  double low_, high_;
  std::string name_;
  std::vector<Tick> ticks_;
  Tick first_, last_;  // at the ends
};

}  // namespace batten
