// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/colour_bar.h>
#include <batten/io/offscreen_window.h>
#include <batten/io/output_file.h>
#include <batten/io/picture.h>
#include <batten/io/picture_views.h>
#include <batten/io/png.h>
#include <batten/io/sample_checks.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

constexpr int most_grid_points = 1000;  // along a side
constexpr std::size_t most_dots = 6000;

void check(const PictureOptions& options) {
  constexpr int smallest = 200, largest = 16000;
  for (const int size : {options.width, options.height}) {
    if (size >= smallest && size <= largest) continue;
    throw InvalidInput("draw_picture: width and height must be from 200 to 16000 pixels, found " +
                       std::to_string(size));
  }
  if (!(options.y_scale > 0 && std::isfinite(options.y_scale)))
    throw InvalidInput("draw_picture: y_scale must be positive");
  if (!(options.relief > 0 && std::isfinite(options.relief)))
    throw InvalidInput("draw_picture: relief must be positive");
  for (const CurveSamples& curve : options.curves) {
    if (curve.x.size() != curve.y.size())
      throw InvalidInput("draw_picture: x and y of a curve must have equal lengths, found " +
                         std::to_string(curve.x.size()) + " and " + std::to_string(curve.y.size()));
  }
}

// Those of the points that lie in the rectangle of the field; every k-th, if they are more than can be told apart.
std::vector<ScenePoint> shown_points(const ScatteredSamples& samples, const PictureField& field) {
  std::vector<ScenePoint> inside;
  for (std::size_t i = 0; i < samples.x.size(); ++i) {
    const bool in_x = samples.x[i] >= field.x.front() && samples.x[i] <= field.x.back();
    const bool in_y = samples.y[i] >= field.y.front() && samples.y[i] <= field.y.back();
    if (in_x && in_y && std::isfinite(samples.z[i])) inside.push_back({samples.x[i], samples.y[i], samples.z[i]});
  }
  const std::size_t step = (inside.size() + most_dots - 1) / most_dots;
  if (step <= 1) return inside;
  std::vector<ScenePoint> shown;
  for (std::size_t i = 0; i < inside.size(); i += step) shown.push_back(inside[i]);
  return shown;
}

Picture::Box box_of(const PlotArea& area, int height) {
  const auto pixel = [](double place) { return static_cast<int>(std::lround(place)); };
  return {pixel(area.low[0]), height - pixel(area.high[1]), pixel(area.high[0]), height - pixel(area.low[1])};
}

// Puts a title on top, a colour bar to the right, and the view into the room that is left.
void compose(const PictureOptions& options, const ColourBar& bar, ViewInput& view, Picture& picture) {
  PlotOverlay& overlay = *view.overlay;
  const double font = overlay.font_size();
  const double width = options.width, height = options.height;
  const TextStyle title = overlay.fitted(
      options.title, {.vertical = TextStyle::Anchor::High, .size = 1.25, .bold = true}, width - 2 * font);
  overlay.add_text(options.title, {width / 2, height - 0.8 * font}, title);
  const double top = height - (options.title.empty() ? 1.2 : 3) * font;
  const double bar_room = bar.width(overlay);
  view.area = {{font, font}, {width - bar_room - 3 * font, top}};
  const bool is_map = options.view == PictureOptions::View::Map;
  const PlotArea plot = is_map ? draw_map(view) : draw_surface(view);

  // Beside a map the bar is as high, but at least half of the room; beside a scene it stands at the right.
  const double middle = (plot.low[1] + plot.high[1]) / 2;
  const double bar_height = is_map ? std::max(plot.height(), 0.5 * view.area.height()) : 0.75 * view.area.height();
  const double bar_low = std::floor(std::clamp(middle - bar_height / 2, view.area.low[1], top - bar_height));
  const double bar_left = std::floor(is_map ? plot.high[0] + 1.5 * font : width - font - bar_room);
  const PlotArea colours = {{bar_left, bar_low},
                            {bar_left + ColourBar::colours_width(overlay), std::floor(bar_low + bar_height)}};
  picture.bar_labels = bar.draw(overlay, colours.low, colours.high[1]);
  picture.plot = box_of(plot, options.height);
  picture.colour_bar = box_of(colours, options.height);
}

}  // namespace

Picture draw_picture(const GridSamples& grid, const ScatteredSamples& points, const PictureOptions& options) {
  check(options);
  check_arrays(points, "draw_picture");
  const PictureField field = picture_field(grid, options.array, most_grid_points);
  const std::vector<ScenePoint> shown = shown_points(points, field);
  const ColourBar bar(field.low, field.high, options.value_name);

  constexpr double font_share = 0.0225, smallest_font = 9;
  const OffscreenWindow window(options.width, options.height);
  PlotOverlay overlay(window.renderer(), std::max(smallest_font, font_share * std::min(options.width, options.height)));
  ViewInput view;
  view.renderer = window.renderer();
  view.overlay = &overlay;
  view.field = &field;
  view.points = shown;
  view.value_ticks = bar.ticks();
  view.options = &options;
  Picture picture;
  compose(options, bar, view, picture);
  picture.width = options.width;
  picture.height = options.height;
  picture.range = {field.low, field.high};
  picture.rgb = window.render();
  return picture;
}

void write_picture(const std::filesystem::path& path, const GridSamples& grid, const ScatteredSamples& points,
                   const PictureOptions& options) {
  OutputFile file(path);
  const Picture picture = draw_picture(grid, points, options);
  file.write(encode_png(picture.width, picture.height, picture.rgb));
  file.commit();
}

}  // namespace batten
