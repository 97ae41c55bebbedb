// SPDX-License-Identifier: MIT
#include <batten/io/picture_views.h>

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace batten {
namespace {

// In font sizes.
constexpr double tick_length = 0.35, label_gap = 0.3, name_gap = 0.5;

// Layers of the scene, farther apart than dots are thick.
constexpr double contour_height = 1, ring_height = 20, dot_height = 40;

// Scene coordinates are pixels.
void set_camera(vtkRenderer* renderer, const PictureOptions& options) {
  const double x = options.width / 2.0, y = options.height / 2.0;
  constexpr double above = 100;
  vtkCamera* const camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(x, y, 0);
  camera->SetPosition(x, y, above);
  camera->SetViewUp(0, 1, 0);
  camera->SetParallelScale(y);
  camera->SetClippingRange(1, 2 * above);
}

double widest_label(const PlotOverlay& overlay, std::span<const Tick> ticks) {
  double widest = 0;
  for (const Tick& tick : ticks) widest = std::max(widest, overlay.text_size(tick.label)[0]);
  return widest;
}

// The largest rectangle of whole pixels with the proportions of the field that leaves room for labels, in the middle of
// the area.
PlotArea plot_rectangle(const ViewInput& view) {
  const PlotOverlay& overlay = *view.overlay;
  const PictureField& field = *view.field;
  const double font = overlay.font_size();
  const double marks = (tick_length + label_gap + name_gap) * font;
  const double left =
      view.area.low[0] + marks + font + widest_label(overlay, nice_ticks(field.y.front(), field.y.back(), 9));
  const double bottom = view.area.low[1] + marks + 2 * font;
  const double room_x = view.area.high[0] - left, room_y = view.area.high[1] - bottom;
  const double width = field.x.back() - field.x.front();
  const double height = (field.y.back() - field.y.front()) * view.options->y_scale;
  const double pixels = std::min(room_x / width, room_y / height);
  const Pixel size = {std::max(1.0, std::floor(pixels * width)), std::max(1.0, std::floor(pixels * height))};
  const Pixel low = {std::floor(left + (room_x - size[0]) / 2), std::floor(bottom + (room_y - size[1]) / 2)};
  return {low, {low[0] + size[0], low[1] + size[1]}};
}

void draw_x_axis(PlotOverlay& overlay, const PlotArea& plot, const PictureField& field, const std::string& name) {
  const double font = overlay.font_size();
  const double low = field.x.front(), high = field.x.back();
  const auto ticks =
      fitting_ticks(low, high, plot.width(), [&](const std::string& label) { return overlay.text_size(label)[0]; });
  const double y = plot.low[1];
  for (const Tick& tick : ticks) {
    const double x = plot.low[0] + plot.width() * (tick.value - low) / (high - low);
    overlay.add_line(std::array<Pixel, 2>{{{x, y}, {x, y - tick_length * font}}}, 1);
    overlay.add_text(tick.label, {x, y - (tick_length + label_gap) * font}, {.vertical = TextStyle::Anchor::High});
  }
  const TextStyle style = overlay.fitted(name, {.vertical = TextStyle::Anchor::High}, plot.width());
  overlay.add_text(name, {(plot.low[0] + plot.high[0]) / 2, y - (tick_length + label_gap + name_gap + 1) * font},
                   style);
}

void draw_y_axis(PlotOverlay& overlay, const PlotArea& plot, const PictureField& field, const std::string& name) {
  const double font = overlay.font_size();
  const double low = field.y.front(), high = field.y.back();
  const auto ticks = fitting_ticks(low, high, plot.height(), [&](const std::string&) { return 1.5 * font; });
  const double x = plot.low[0];
  for (const Tick& tick : ticks) {
    const double y = plot.low[1] + plot.height() * (tick.value - low) / (high - low);
    overlay.add_line(std::array<Pixel, 2>{{{x, y}, {x - tick_length * font, y}}}, 1);
    overlay.add_text(tick.label, {x - (tick_length + label_gap) * font, y}, {.horizontal = TextStyle::Anchor::High});
  }
  const double labels = widest_label(overlay, ticks);
  const TextStyle style = overlay.fitted(name, {.horizontal = TextStyle::Anchor::High, .upwards = true}, plot.height());
  overlay.add_text(name, {x - (tick_length + label_gap + name_gap) * font - labels, (plot.low[1] + plot.high[1]) / 2},
                   style);
}

void draw_points(const ViewInput& view, const SceneScale& scale, double area) {
  if (view.points.empty()) return;
  constexpr double white = 1, black = 0.05, smallest_with_ring = 3;
  std::vector<ScenePoint> rings, dots;
  for (const auto& [x, y, z] : view.points) {
    rings.push_back({scale.x(x), scale.y(y), ring_height});
    dots.push_back({scale.x(x), scale.y(y), dot_height});
  }
  const double diameter = dot_diameter(view.points.size(), area);
  if (diameter >= smallest_with_ring) add_dots(view.renderer, rings, diameter + 2, white);
  add_dots(view.renderer, dots, diameter, black);
}

}  // namespace

double dot_diameter(std::size_t count, double area) {
  constexpr double smallest = 1.5, largest = 7, share = 0.2;  // of the mean distance between points
  return std::clamp(share * std::sqrt(area / static_cast<double>(std::max<std::size_t>(count, 1))), smallest, largest);
}

PlotArea draw_map(ViewInput& view) {
  const PictureField& field = *view.field;
  const PlotArea plot = plot_rectangle(view);
  SceneScale scale;
  scale.factor = {plot.width() / (field.x.back() - field.x.front()),
                  plot.height() / (field.y.back() - field.y.front())};
  scale.origin = {field.x.front() - plot.low[0] / scale.factor[0], field.y.front() - plot.low[1] / scale.factor[1]};
  view.mesh = scene_mesh(field, scale);

  set_camera(view.renderer, *view.options);
  add_mesh(view.renderer, view.mesh, Shading::Flat);
  std::vector<double> levels;
  for (const Tick& tick : view.value_ticks) levels.push_back((tick.value - field.low) / (field.high - field.low));
  add_contours(view.renderer, view.mesh, levels, {.width = 1, .opacity = 0.5, .lift = contour_height});
  draw_points(view, scale, plot.width() * plot.height());

  const Pixel low = plot.low, high = plot.high;
  view.overlay->add_line(std::array<Pixel, 5>{{low, {high[0], low[1]}, high, {low[0], high[1]}, low}}, 1);
  draw_x_axis(*view.overlay, plot, field, view.options->x_name);
  draw_y_axis(*view.overlay, plot, field, view.options->y_name);
  return plot;
}

}  // namespace batten
