// SPDX-License-Identifier: MIT
#include <batten/io/picture_views.h>

#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace batten {
namespace {

// In font sizes.
constexpr double tick_length = 0.35, label_gap = 0.35, name_gap = 0.6;

double dot(const ScenePoint& a, const ScenePoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The box around the surface: its plan is centred at 0, the longer side has length 1, the floor is at 0.
struct SceneBox {
  double x = 0.5, y = 0.5;  // half the sides of the plan
  double z = 0;             // height

  std::array<ScenePoint, 8> corners() const {
    return {{{-x, -y, 0}, {x, -y, 0}, {-x, y, 0}, {x, y, 0}, {-x, -y, z}, {x, -y, z}, {-x, y, z}, {x, y, z}}};
  }
};

// A camera south of the scene, a little to the east and above, that looks at the middle of the box, and where it sees
// each point in the window. With a = right·v, b = up·v, c = forward·v for v = point - eye, the point is seen at
// centre + scale (a, b) / c.
class Perspective {
public:
  // The box fills the area as far as its proportions allow.
  Perspective(const SceneBox& box, const PlotArea& area) {
    constexpr double azimuth = -60 * std::numbers::pi / 180, elevation = 33 * std::numbers::pi / 180, distance = 3.5;
    const double ca = std::cos(azimuth), sa = std::sin(azimuth), ce = std::cos(elevation), se = std::sin(elevation);
    focal_ = {0, 0, box.z / 2};
    forward_ = {-ca * ce, -sa * ce, -se};
    right_ = {-sa, ca, 0};
    up_ = {-ca * se, -sa * se, ce};
    for (std::size_t c = 0; c < 3; ++c) eye_[c] = focal_[c] - distance * forward_[c];
    fit(box, area);
  }

  Pixel place(const ScenePoint& point) const {
    const ScenePoint v = {point[0] - eye_[0], point[1] - eye_[1], point[2] - eye_[2]};
    const double c = dot(forward_, v);
    return {centre_[0] + scale_ * dot(right_, v) / c, centre_[1] + scale_ * dot(up_, v) / c};
  }

  // The point moved towards the eye by a share of its distance: it is seen at the same place.
  ScenePoint nearer(const ScenePoint& point, double share) const {
    ScenePoint moved = {};
    for (std::size_t c = 0; c < 3; ++c) moved[c] = point[c] + share * (eye_[c] - point[c]);
    return moved;
  }

  PlotArea extent(const SceneBox& box) const {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    PlotArea extent = {{infinite, infinite}, {-infinite, -infinite}};
    for (const ScenePoint& corner : box.corners()) {
      const Pixel seen = place(corner);
      for (std::size_t k = 0; k < 2; ++k) {
        extent.low[k] = std::min(extent.low[k], seen[k]);
        extent.high[k] = std::max(extent.high[k], seen[k]);
      }
    }
    return extent;
  }

  void apply(vtkRenderer* renderer, const PictureOptions& options) const {
    const double half_width = options.width / 2.0, half_height = options.height / 2.0;
    vtkCamera* const camera = renderer->GetActiveCamera();
    camera->SetPosition(eye_.data());
    camera->SetFocalPoint(focal_.data());
    camera->SetViewUp(0, 0, 1);
    camera->SetViewAngle(2 * std::atan(half_height / scale_) * 180 / std::numbers::pi);
    camera->SetWindowCenter(1 - centre_[0] / half_width, 1 - centre_[1] / half_height);
    renderer->ResetCameraClippingRange();
  }

private:
  void fit(const SceneBox& box, const PlotArea& area) {
    const PlotArea found = extent(box);  // with scale 1 and centre 0
    scale_ = std::min(area.width() / found.width(), area.height() / found.height());
    for (std::size_t k = 0; k < 2; ++k) {
      centre_[k] = (area.low[k] + area.high[k]) / 2 - scale_ * (found.low[k] + found.high[k]) / 2;
    }
  }

  ScenePoint eye_ = {}, focal_ = {}, forward_ = {}, right_ = {}, up_ = {};
  Pixel centre_ = {0, 0};
  double scale_ = 1;
};

// One labelled edge of the box.
struct Axis {
  ScenePoint from, to;
  double low = 0, high = 1;  // values at the ends
  std::string name;
  ScenePoint outwards;  // the direction from the edge to its labels
  std::vector<Tick> ticks;

  ScenePoint at(double value) const {
    const double t = high > low ? (value - low) / (high - low) : 0.5;
    ScenePoint point = {};
    for (std::size_t c = 0; c < 3; ++c) point[c] = from[c] + t * (to[c] - from[c]);
    return point;
  }
};

ScenePoint moved(const ScenePoint& point, const ScenePoint& direction, double distance) {
  return {point[0] + distance * direction[0], point[1] + distance * direction[1], point[2] + distance * direction[2]};
}

Pixel moved(const Pixel& place, const Pixel& direction, double distance) {
  return {place[0] + distance * direction[0], place[1] + distance * direction[1]};
}

Pixel unit_direction(const Pixel& from, const Pixel& to) {
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
  return {(to[0] - from[0]) / length, (to[1] - from[1]) / length};
}

// How far from an edge the middle of a text must be, going in direction d as seen, for the text to be clear of the
// edge.
double clearance(const Pixel& size, const Pixel& edge, const Pixel& d) {
  const Pixel normal = {-edge[1], edge[0]};
  const double reach = (std::abs(normal[0]) * size[0] + std::abs(normal[1]) * size[1]) / 2;
  constexpr double least = 0.3;  // nearly along the edge there is no such distance
  return reach / std::max(std::abs(normal[0] * d[0] + normal[1] * d[1]), least);
}

// A text and the middle of its place.
struct Label {
  std::string text;
  Pixel place = {0, 0};
  TextStyle style;
};

// What is drawn of an axis outside the box.
struct AxisMarks {
  std::vector<std::array<Pixel, 2>> lines;
  std::vector<Label> labels;
};

AxisMarks marks_of(const Axis& axis, const PlotOverlay& overlay, const Perspective& view) {
  constexpr double small = 0.01;
  const double font = overlay.font_size();
  const Pixel from = view.place(axis.from), to = view.place(axis.to);
  const Pixel edge = unit_direction(from, to);
  AxisMarks marks = {{{from, to}}, {}};
  double farthest = 0;
  for (const Tick& tick : axis.ticks) {
    const ScenePoint point = axis.at(tick.value);
    const Pixel place = view.place(point);
    const Pixel d = unit_direction(place, view.place(moved(point, axis.outwards, small)));
    const double clear = clearance(overlay.text_size(tick.label), edge, d);
    marks.lines.push_back({place, moved(place, d, tick_length * font)});
    marks.labels.push_back({tick.label, moved(place, d, (tick_length + label_gap) * font + clear), {}});
    farthest = std::max(farthest, 2 * clear);
  }
  const ScenePoint middle = axis.at((axis.low + axis.high) / 2);
  const Pixel place = view.place(middle);
  const Pixel d = unit_direction(place, view.place(moved(middle, axis.outwards, small)));
  const bool upright = std::abs(edge[0]) < 0.2;
  const double length = std::max(std::hypot(to[0] - from[0], to[1] - from[1]), 8 * font);
  const TextStyle style = overlay.fitted(axis.name, {.upwards = upright}, length);
  const double distance = (tick_length + label_gap + name_gap) * font + farthest;
  const double clear = clearance(overlay.text_size(axis.name, style), edge, d);
  marks.labels.push_back({axis.name, moved(place, d, distance + clear), style});
  return marks;
}

void draw(PlotOverlay& overlay, const AxisMarks& marks) {
  constexpr double line_width = 1.2;
  for (const auto& line : marks.lines) overlay.add_line(line, {.width = line_width});
  for (const Label& label : marks.labels) overlay.add_text(label.text, label.place, label.style);
}

// As many ticks as their labels leave room for along the edge as seen.
std::vector<Tick> ticks_along(const Axis& axis, const PlotOverlay& overlay, const Perspective& view) {
  const Pixel from = view.place(axis.from), to = view.place(axis.to);
  const double run_x = std::abs(to[0] - from[0]), run_y = std::abs(to[1] - from[1]);
  // Two labels are clear of each other where they are apart in x or in y.
  return fitting_ticks(axis.low, axis.high, 1, [&](const std::string& label) {
    const auto [width, height] = overlay.text_size(label);
    return std::min(width / std::max(run_x, 1.0), 1.2 * height / std::max(run_y, 1.0));
  });
}

std::array<Axis, 3> axes_of(const SceneBox& box, const ViewInput& view) {
  const PictureField& field = *view.field;
  const ScenePoint near = {-box.x, -box.y, 0};
  const ScenePoint left = {-1, -0.6, 0};  // nearly so in the picture
  Axis x = {near, {box.x, -box.y, 0}, field.x.front(), field.x.back(), view.options->x_name, {0, -1, 0}, {}};
  Axis y = {
      {box.x, -box.y, 0}, {box.x, box.y, 0}, field.y.front(), field.y.back(), view.options->y_name, {1, 0, 0}, {}};
  Axis z = {near, {-box.x, -box.y, box.z}, field.low, field.high, view.options->value_name, left, {}};
  return {x, y, z};
}

// The floor and the two walls behind, with lines at the ticks. They are drawn a little farther from the eye than they
// are, so that they do not shine through a surface that lies on the floor.
void draw_walls(vtkRenderer* renderer, const SceneBox& box, const std::array<Axis, 3>& axes,
                const Perspective& perspective) {
  constexpr double line_grey = 0.85, edge_grey = 0.55, recess = 0.005;
  const auto farther = [&](const SceneLine& line) {
    return SceneLine{perspective.nearer(line[0], -recess), perspective.nearer(line[1], -recess)};
  };
  const double x = box.x, y = box.y, z = box.z;
  std::vector<SceneLine> lines;
  for (const Tick& tick : axes[0].ticks) {
    const double at = axes[0].at(tick.value)[0];
    lines.insert(lines.end(), {{{{at, -y, 0}, {at, y, 0}}}, {{{at, y, 0}, {at, y, z}}}});
  }
  for (const Tick& tick : axes[1].ticks) {
    const double at = axes[1].at(tick.value)[1];
    lines.insert(lines.end(), {{{{-x, at, 0}, {x, at, 0}}}, {{{-x, at, 0}, {-x, at, z}}}});
  }
  for (const Tick& tick : axes[2].ticks) {
    const double at = axes[2].at(tick.value)[2];
    lines.insert(lines.end(), {{{{-x, -y, at}, {-x, y, at}}}, {{{-x, y, at}, {x, y, at}}}});
  }
  std::ranges::transform(lines, lines.begin(), farther);
  add_lines(renderer, lines, {.width = 1, .grey = line_grey});
  std::array<SceneLine, 7> edges = {{{{{-x, -y, 0}, {-x, y, 0}}},
                                     {{{-x, y, 0}, {x, y, 0}}},
                                     {{{-x, -y, z}, {-x, y, z}}},
                                     {{{-x, y, z}, {x, y, z}}},
                                     {{{-x, y, 0}, {-x, y, z}}},
                                     {{{x, y, 0}, {x, y, z}}},
                                     {{{-x, -y, 0}, {-x, -y, z}}}}};
  std::ranges::transform(edges, edges.begin(), farther);
  add_lines(renderer, edges, {.width = 1, .grey = edge_grey});
}

void add_light(vtkRenderer* renderer, const ScenePoint& towards, double intensity) {
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->PositionalOff();
  light->SetFocalPoint(0, 0, 0);
  light->SetPosition(towards.data());
  light->SetIntensity(intensity);
  renderer->AddLight(light);
}

// A main light from the left above, as maps have it, and a weak one from the viewer's side.
void set_lights(vtkRenderer* renderer) {
  renderer->AutomaticLightCreationOff();
  renderer->RemoveAllLights();
  add_light(renderer, {-0.8, -0.25, 1.0}, 0.75);
  add_light(renderer, {0.6, -1.0, 0.6}, 0.45);
}

// Dots are drawn a little nearer to the eye than they are, so that the surface through them does not hide them.
void draw_points(const ViewInput& view, const SceneScale& scale, const Perspective& perspective, double area) {
  if (view.points.empty()) return;
  constexpr double black = 0.05, white = 1, smallest_with_ring = 3, ring_lift = 0.006, dot_lift = 0.018;
  const double span = view.field->high - view.field->low;
  std::vector<ScenePoint> rings, dots;
  for (const auto& [x, y, z] : view.points) {
    const double level = span > 0 ? (z - view.field->low) / span : 0.5;
    const ScenePoint place = {scale.x(x), scale.y(y), scale.height * level};
    rings.push_back(perspective.nearer(place, ring_lift));
    dots.push_back(perspective.nearer(place, dot_lift));
  }
  const double diameter = dot_diameter(dots.size(), area);
  if (diameter >= smallest_with_ring) add_dots(view.renderer, rings, diameter + 2, white);
  add_dots(view.renderer, dots, diameter, black);
}

// The rectangle that the box and all labels need; gives the axes the ticks for this view.
PlotArea needed_area(const SceneBox& box, const ViewInput& view, const Perspective& perspective,
                     std::array<Axis, 3>& axes) {
  PlotArea needed = perspective.extent(box);
  for (Axis& axis : axes) {
    axis.ticks = ticks_along(axis, *view.overlay, perspective);
    for (const Label& label : marks_of(axis, *view.overlay, perspective).labels) {
      const auto [width, height] = view.overlay->text_size(label.text, label.style);
      const auto [x, y] = label.place;
      needed.low = {std::min(needed.low[0], x - width / 2), std::min(needed.low[1], y - height / 2)};
      needed.high = {std::max(needed.high[0], x + width / 2), std::max(needed.high[1], y + height / 2)};
    }
  }
  return needed;
}

// The box seen as large as it can be with all labels in the area. Their sizes and ticks depend on the view in turn, so
// it is found by a few rounds of making room for what stuck out.
Perspective fitted_view(const SceneBox& box, const ViewInput& view, std::array<Axis, 3>& axes) {
  constexpr int rounds = 4;
  Perspective perspective(box, view.area);
  for (int round = 0; round < rounds; ++round) {
    const PlotArea needed = needed_area(box, view, perspective, axes);
    const PlotArea extent = perspective.extent(box);
    PlotArea room = view.area;
    for (std::size_t k = 0; k < 2; ++k) {
      room.low[k] += extent.low[k] - needed.low[k];
      room.high[k] -= needed.high[k] - extent.high[k];
    }
    perspective = Perspective(box, room);
  }
  needed_area(box, view, perspective, axes);
  return perspective;
}

}  // namespace

PlotArea draw_surface(ViewInput& view) {
  const PictureField& field = *view.field;
  const double width = field.x.back() - field.x.front();
  const double depth = (field.y.back() - field.y.front()) * view.options->y_scale;
  const double unit = 1 / std::max(width, depth);
  const SceneBox box = {unit * width / 2, unit * depth / 2, view.options->relief};
  SceneScale scale;
  scale.origin = {(field.x.front() + field.x.back()) / 2, (field.y.front() + field.y.back()) / 2};
  scale.factor = {unit, unit * view.options->y_scale};
  scale.height = view.options->relief;
  view.mesh = scene_mesh(field, scale);

  std::array<Axis, 3> axes = axes_of(box, view);
  const Perspective perspective = fitted_view(box, view, axes);
  const PlotArea plot = perspective.extent(box);
  draw_walls(view.renderer, box, axes, perspective);
  set_lights(view.renderer);
  add_mesh(view.renderer, view.mesh, Shading::Lit);
  draw_points(view, scale, perspective, 0.5 * plot.width() * plot.height());
  for (const Axis& axis : axes) draw(*view.overlay, marks_of(axis, *view.overlay, perspective));
  perspective.apply(view.renderer, *view.options);
  return plot;
}

}  // namespace batten
