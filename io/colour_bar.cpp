// SPDX-License-Identifier: MIT
#include <batten/io/colour_bar.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace batten {
namespace {

// In font sizes.
constexpr double bar_width = 1.2, tick_length = 0.3, label_gap = 0.3, name_gap = 0.6;

}  // namespace

ColourBar::ColourBar(double low, double high, std::string name)
    : low_(low), high_(high), name_(std::move(name)), ticks_(nice_ticks(low, high, 9)) {
  // The ends are no round values: they have one digit more.
  const double step =
      ticks_.size() > 1 ? ticks_[1].value - ticks_[0].value : std::max(high - low, std::abs(low) * 1e-6);
  first_ = {low, number_label(low, step / 10)};
  last_ = {high, number_label(high, step / 10)};
}

double ColourBar::colours_width(const PlotOverlay& overlay) { return bar_width * overlay.font_size(); }

double ColourBar::width(const PlotOverlay& overlay) const {
  double labels = std::max(overlay.text_size(first_.label)[0], overlay.text_size(last_.label)[0]);
  for (const Tick& tick : ticks_) labels = std::max(labels, overlay.text_size(tick.label)[0]);
  const double name = name_.empty() ? 0 : name_gap * overlay.font_size() + overlay.text_size(name_)[1];
  return (bar_width + tick_length + label_gap) * overlay.font_size() + labels + name;
}

std::vector<std::string> ColourBar::draw(PlotOverlay& overlay, const Pixel& low, double top) const {
  const double font = overlay.font_size();
  const double right = low[0] + bar_width * font;
  const auto height = [&](double value) {
    return high_ > low_ ? low[1] + (top - low[1]) * (value - low_) / (high_ - low_) : (low[1] + top) / 2;
  };
  std::vector<Tick> shown;
  for (const Tick& tick : ticks_) {
    const double clearance = std::min(height(tick.value) - low[1], top - height(tick.value));
    if (clearance > 1.2 * font) shown.push_back(tick);
  }
  shown.insert(shown.begin(), first_);
  if (high_ > low_) shown.push_back(last_);

  overlay.add_colour_bar(low, {right, top});
  overlay.add_line(std::array<Pixel, 5>{{low, {right, low[1]}, {right, top}, {low[0], top}, low}}, {});
  std::vector<std::string> labels;
  for (const Tick& tick : shown) {
    const double y = height(tick.value);
    overlay.add_line(std::array<Pixel, 2>{{{right, y}, {right + tick_length * font, y}}}, {});
    overlay.add_text(tick.label, {right + (tick_length + label_gap) * font, y}, {.horizontal = TextStyle::Anchor::Low});
    labels.push_back(tick.label);
  }
  const TextStyle style = overlay.fitted(
      name_, {.horizontal = TextStyle::Anchor::High, .vertical = TextStyle::Anchor::Centre, .upwards = true},
      top - low[1]);
  overlay.add_text(name_, {low[0] + width(overlay), (low[1] + top) / 2}, style);
  return labels;
}

}  // namespace batten
