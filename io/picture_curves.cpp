// SPDX-License-Identifier: MIT
#include <batten/io/picture_curves.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

using Place = std::array<double, 2>;  // in the scene, whose unit is the pixel

double distance(const Place& a, const Place& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

// The parts of a curve inside the field, points at least a pixel apart but for the last.
std::vector<std::vector<Place>> parts_of(const CurveSamples& curve, const PictureField& field,
                                         const SceneScale& scale) {
  std::vector<std::vector<Place>> parts(1);
  const std::size_t count = curve.x.size() + (curve.closed && !curve.x.empty() ? 1 : 0);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = curve.x[i % curve.x.size()], y = curve.y[i % curve.x.size()];
    const bool inside = x >= field.x.front() && x <= field.x.back() && y >= field.y.front() && y <= field.y.back();
    if (!inside) {
      if (!parts.back().empty()) parts.emplace_back();
      continue;
    }
    const Place place = {scale.x(x), scale.y(y)};
    if (parts.back().empty() || i + 1 == count || distance(parts.back().back(), place) >= 1)
      parts.back().push_back(place);
  }
  std::erase_if(parts, [](const std::vector<Place>& part) { return part.size() < 2; });
  return parts;
}

double length_of(const std::vector<Place>& part) {
  double length = 0;
  for (std::size_t i = 1; i < part.size(); ++i) length += distance(part[i - 1], part[i]);
  return length;
}

// Two strokes from a tip that lies so far along the part, in its direction there.
void add_head(const std::vector<Place>& part, double along, double size, std::vector<SceneLine>& lines) {
  std::size_t i = 1;
  for (; i + 1 < part.size() && distance(part[i - 1], part[i]) < along; ++i) along -= distance(part[i - 1], part[i]);
  const Place &from = part[i - 1], &to = part[i];
  const double length = distance(from, to);
  if (length == 0) return;
  const Place forward = {(to[0] - from[0]) / length, (to[1] - from[1]) / length};
  const double gone = std::min(along, length);
  const ScenePoint tip = {from[0] + gone * forward[0], from[1] + gone * forward[1], 0};
  constexpr double half_width = 0.45;  // of the length of the head
  for (const double side : {-half_width, half_width})
    lines.push_back(
        {tip, {tip[0] - size * (forward[0] - side * forward[1]), tip[1] - size * (forward[1] + side * forward[0]), 0}});
}

}  // namespace

void draw_curves(const ViewInput& view, const SceneScale& scale) {
  const PictureOptions& options = *view.options;
  const bool at_end = options.heads == PictureOptions::Heads::End;
  // In font sizes; the share is of an arrow's length.
  constexpr double head = 0.5, heads_apart = 12, shortest_with_head = 1.5, largest_share = 0.4;
  const double font = view.overlay->font_size();
  std::vector<SceneLine> lines;
  for (const CurveSamples& curve : options.curves) {
    for (const std::vector<Place>& part : parts_of(curve, *view.field, scale)) {
      for (std::size_t i = 1; i < part.size(); ++i)
        lines.push_back({ScenePoint{part[i - 1][0], part[i - 1][1], 0}, ScenePoint{part[i][0], part[i][1], 0}});
      const double length = length_of(part);
      if (at_end) {
        add_head(part, length, std::min(head * font, largest_share * length), lines);
      } else if (length > shortest_with_head * font) {
        const int count = std::max(1, static_cast<int>(length / (heads_apart * font)));
        for (int k = 0; k < count; ++k) add_head(part, length * (k + 0.5) / count, head * font, lines);
      }
    }
  }
  if (lines.empty()) return;
  constexpr double edge_height = 4, line_height = 8;  // between contour lines and dots
  add_lines(view.renderer, lines, {.width = 3.5, .grey = 0, .opacity = 0.55, .lift = edge_height});
  add_lines(view.renderer, lines, {.width = 1.5, .grey = 1, .lift = line_height});
}

}  // namespace batten
