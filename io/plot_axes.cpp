// SPDX-License-Identifier: MIT
#include <batten/io/plot_axes.h>

#include <algorithm>
#include <span>

namespace batten {
namespace {

// In font sizes.
constexpr double tick_length = 0.35, label_gap = 0.3, name_gap = 0.5;

double widest_label(const PlotOverlay& overlay, std::span<const Tick> ticks) {
  double widest = 0;
  for (const Tick& tick : ticks) widest = std::max(widest, overlay.text_size(tick.label)[0]);
  return widest;
}

void draw_x_axis(PlotOverlay& overlay, const PlotArea& plot, const AxisRange& range) {
  const double font = overlay.font_size(), y = plot.low[1];
  const auto ticks = fitting_ticks(range.low, range.high, plot.width(),
                                   [&](const std::string& label) { return overlay.text_size(label)[0]; });
  for (const Tick& tick : ticks) {
    const double x = plot.low[0] + plot.width() * (tick.value - range.low) / (range.high - range.low);
    overlay.add_line(std::array<Pixel, 2>{{{x, y}, {x, y - tick_length * font}}}, {});
    overlay.add_text(tick.label, {x, y - (tick_length + label_gap) * font}, {.vertical = TextStyle::Anchor::High});
  }
  const TextStyle style = overlay.fitted(range.name, {.vertical = TextStyle::Anchor::High}, plot.width());
  overlay.add_text(range.name, {(plot.low[0] + plot.high[0]) / 2, y - (tick_length + label_gap + name_gap + 1) * font},
                   style);
}

void draw_y_axis(PlotOverlay& overlay, const PlotArea& plot, const AxisRange& range) {
  const double font = overlay.font_size(), x = plot.low[0];
  const auto ticks =
      fitting_ticks(range.low, range.high, plot.height(), [&](const std::string&) { return 1.5 * font; });
  for (const Tick& tick : ticks) {
    const double y = plot.low[1] + plot.height() * (tick.value - range.low) / (range.high - range.low);
    overlay.add_line(std::array<Pixel, 2>{{{x, y}, {x - tick_length * font, y}}}, {});
    overlay.add_text(tick.label, {x - (tick_length + label_gap) * font, y}, {.horizontal = TextStyle::Anchor::High});
  }
  const double labels = widest_label(overlay, ticks);
  const TextStyle style =
      overlay.fitted(range.name, {.horizontal = TextStyle::Anchor::High, .upwards = true}, plot.height());
  overlay.add_text(range.name,
                   {x - (tick_length + label_gap + name_gap) * font - labels, (plot.low[1] + plot.high[1]) / 2}, style);
}

}  // namespace

std::array<double, 2> axis_margins(const PlotOverlay& overlay, const AxisRange& y) {
  const double font = overlay.font_size(), marks = (tick_length + label_gap + name_gap) * font;
  return {marks + font + widest_label(overlay, nice_ticks(y.low, y.high, 9)), marks + 2 * font};
}

void draw_axes(PlotOverlay& overlay, const PlotArea& plot, const AxisRange& x, const AxisRange& y) {
  const Pixel low = plot.low, high = plot.high;
  overlay.add_line(std::array<Pixel, 5>{{low, {high[0], low[1]}, high, {low[0], high[1]}, low}}, {});
  draw_x_axis(overlay, plot, x);
  draw_y_axis(overlay, plot, y);
}

}  // namespace batten
