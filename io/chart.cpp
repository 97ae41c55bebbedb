// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/chart.h>
#include <batten/io/offscreen_window.h>
#include <batten/io/output_file.h>
#include <batten/io/plot_axes.h>
#include <batten/io/png.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace batten {
namespace {

constexpr std::array<std::array<std::uint8_t, 3>, 7> palette = {
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {86, 180, 233}, {230, 159, 0}, {90, 90, 90}}};
constexpr double line_width = 2.5, dot_width = 8;
constexpr double shortest_piece = 2;  // pixels: the renderer breaks lines of shorter pieces

void check(std::span<const ChartLine> lines, const ChartOptions& options) {
  for (const int size : {options.width, options.height})
    if (size < 200 || size > 16000)
      throw InvalidInput("draw_chart: width and height must be from 200 to 16000 pixels, found " +
                         std::to_string(size));
  for (const ChartLine& line : lines)
    if (line.curve.x.size() != line.curve.y.size())
      throw InvalidInput("draw_chart: x and y of '" + line.curve.name + "' must have equal lengths, found " +
                         std::to_string(line.curve.x.size()) + " and " + std::to_string(line.curve.y.size()));
}

/// The finite values of one coordinate, a little widened.
AxisRange range_of(std::span<const ChartLine> lines, std::vector<double> CurveSamples::*values, std::string name) {
  constexpr double margin = 0.04;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const ChartLine& line : lines)
    for (const double v : line.curve.*values) {
      if (!std::isfinite(v)) continue;
      low = std::min(low, v);
      high = std::max(high, v);
    }
  if (!(low <= high)) throw InvalidInput("draw_chart: there is no finite value to draw");
  const double length = high > low ? high - low : std::max(1., std::abs(low));
  return {low - margin * length, high + margin * length, std::move(name)};
}

/// Both axes at one scale: the one that has room to spare is widened.
void equalise(const PlotArea& plot, AxisRange& x, AxisRange& y) {
  const double unit = std::max((x.high - x.low) / plot.width(), (y.high - y.low) / plot.height());
  const auto widen = [](AxisRange& range, double length) {
    const double middle = (range.low + range.high) / 2;
    range.low = middle - length / 2;
    range.high = middle + length / 2;
  };
  widen(x, unit * plot.width());
  widen(y, unit * plot.height());
}

PenStyle style_of(std::size_t line, double width) {
  PenStyle style{.width = width};
  for (std::size_t c = 0; c < 3; ++c) style.colour[c] = palette[line % palette.size()][c] / 255.;
  return style;
}

struct Frame {
  PlotArea plot;
  AxisRange x, y;
  Pixel operator()(double px, double py) const {
    return {plot.low[0] + plot.width() * (px - x.low) / (x.high - x.low),
            plot.low[1] + plot.height() * (py - y.low) / (y.high - y.low)};
  }
};

std::vector<Pixel> without_short_pieces(const std::vector<Pixel>& run) {
  std::vector<Pixel> kept = {run.front()};
  for (const Pixel& place : run)
    if (std::hypot(place[0] - kept.back()[0], place[1] - kept.back()[1]) >= shortest_piece) kept.push_back(place);
  if (kept.back() != run.back()) kept.push_back(run.back());
  return kept;
}

void draw_line(PlotOverlay& overlay, const Frame& frame, const ChartLine& line, std::size_t number) {
  const CurveSamples& curve = line.curve;
  const std::size_t count = curve.x.size() + (curve.closed && !curve.x.empty() ? 1 : 0);
  std::vector<Pixel> run, dots;
  const auto finish = [&] {
    if (run.size() > 1) overlay.add_line(without_short_pieces(run), style_of(number, line_width));
    run.clear();
  };
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = k % curve.x.size();
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) {
      finish();
      continue;
    }
    run.push_back(frame(curve.x[i], curve.y[i]));
    dots.push_back(run.back());
  }
  if (line.style != ChartLine::Style::Dots) finish();
  if (line.style != ChartLine::Style::Line) overlay.add_dots(dots, style_of(number, dot_width));
}

/// Names beside a piece of each line, in a column to the right of the plot.
void draw_legend(PlotOverlay& overlay, const PlotArea& plot, std::span<const ChartLine> lines) {
  const double font = overlay.font_size();
  double y = plot.high[1] - font;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (lines[k].curve.name.empty()) continue;
    const double left = plot.high[0] + font, right = left + 2 * font;
    if (lines[k].style != ChartLine::Style::Dots)
      overlay.add_line(std::array<Pixel, 2>{{{left, y}, {right, y}}}, style_of(k, line_width));
    if (lines[k].style != ChartLine::Style::Line)
      overlay.add_dots(std::array<Pixel, 1>{{{(left + right) / 2, y}}}, style_of(k, dot_width));
    overlay.add_text(lines[k].curve.name, {right + 0.5 * font, y}, {.horizontal = TextStyle::Anchor::Low});
    y -= 1.6 * font;
  }
}

double legend_width(const PlotOverlay& overlay, std::span<const ChartLine> lines) {
  double widest = 0;
  for (const ChartLine& line : lines) widest = std::max(widest, overlay.text_size(line.curve.name)[0]);
  return widest > 0 ? widest + 4.5 * overlay.font_size() : overlay.font_size();
}

}  // namespace

Chart draw_chart(std::span<const ChartLine> lines, const ChartOptions& options) {
  check(lines, options);
  Frame frame{{}, range_of(lines, &CurveSamples::x, options.x_name), range_of(lines, &CurveSamples::y, options.y_name)};
  constexpr double font_share = 0.0225, smallest_font = 9;
  const OffscreenWindow window(options.width, options.height);
  PlotOverlay overlay(window.renderer(), std::max(smallest_font, font_share * std::min(options.width, options.height)));
  const double font = overlay.font_size(), width = options.width, height = options.height;
  const TextStyle title = overlay.fitted(
      options.title, {.vertical = TextStyle::Anchor::High, .size = 1.25, .bold = true}, width - 2 * font);
  overlay.add_text(options.title, {width / 2, height - 0.8 * font}, title);
  const auto margins = axis_margins(overlay, frame.y);
  frame.plot = {{std::floor(font + margins[0]), std::floor(font + margins[1])},
                {std::floor(width - legend_width(overlay, lines) - font),
                 std::floor(height - (options.title.empty() ? 1.2 : 3) * font)}};
  if (options.equal_scale) equalise(frame.plot, frame.x, frame.y);
  draw_axes(overlay, frame.plot, frame.x, frame.y);
  Chart chart;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    draw_line(overlay, frame, lines[k], k);
    chart.line_colour.push_back(palette[k % palette.size()]);
  }
  draw_legend(overlay, frame.plot, lines);
  chart.width = options.width;
  chart.height = options.height;
  chart.range = {frame.x.low, frame.x.high, frame.y.low, frame.y.high};
  chart.plot = {frame.plot.low[0], frame.plot.high[0], height - frame.plot.high[1], height - frame.plot.low[1]};
  chart.rgb = window.render();
  return chart;
}

void write_chart(const std::filesystem::path& path, std::span<const ChartLine> lines, const ChartOptions& options) {
  OutputFile file(path);
  const Chart chart = draw_chart(lines, options);
  file.write(encode_png(chart.width, chart.height, chart.rgb));
  file.commit();
}

}  // namespace batten
