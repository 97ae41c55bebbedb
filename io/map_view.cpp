// SPDX-License-Identifier: MIT
#include <batten/io/picture_curves.h>

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace batten {
namespace {

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

// The largest rectangle of whole pixels with the proportions of the field that leaves room for labels, in the middle of
// the area.
PlotArea plot_rectangle(const ViewInput& view) {
  const PictureField& field = *view.field;
  const auto margins = axis_margins(*view.overlay, {field.y.front(), field.y.back(), view.options->y_name});
  const double left = view.area.low[0] + margins[0], bottom = view.area.low[1] + margins[1];
  const double room_x = view.area.high[0] - left, room_y = view.area.high[1] - bottom;
  const double width = field.x.back() - field.x.front();
  const double height = (field.y.back() - field.y.front()) * view.options->y_scale;
  const double pixels = std::min(room_x / width, room_y / height);
  const Pixel size = {std::max(1.0, std::floor(pixels * width)), std::max(1.0, std::floor(pixels * height))};
  const Pixel low = {std::floor(left + (room_x - size[0]) / 2), std::floor(bottom + (room_y - size[1]) / 2)};
  return {low, {low[0] + size[0], low[1] + size[1]}};
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
  const auto level_of = [&](double value) { return (value - field.low) / (field.high - field.low); };
  std::vector<double> levels;
  if (view.options->contours)
    for (const Tick& tick : view.value_ticks) levels.push_back(level_of(tick.value));
  add_contours(view.renderer, view.mesh, levels, {.width = 1, .opacity = 0.5, .lift = contour_height});
  if (const auto& bold = view.options->bold_value; bold && field.low < *bold && *bold < field.high)
    add_contours(view.renderer, view.mesh, std::array{level_of(*bold)}, {.width = 4, .lift = contour_height});
  draw_curves(view, scale);
  draw_points(view, scale, plot.width() * plot.height());

  draw_axes(*view.overlay, plot, {field.x.front(), field.x.back(), view.options->x_name},
            {field.y.front(), field.y.back(), view.options->y_name});
  return plot;
}

}  // namespace batten
