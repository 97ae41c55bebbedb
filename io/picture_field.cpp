// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/picture_field.h>
#include <batten/io/sample_checks.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace batten {
namespace {

const PointArray& array_of(const GridSamples& grid, const std::string& name) {
  const auto found = std::find_if(grid.arrays.begin(), grid.arrays.end(),
                                  [&](const PointArray& array) { return array.name == name && array.components == 1; });
  if (found == grid.arrays.end()) {
    throw InvalidInput("draw_picture: the grid has no array '" + name + "' with one component");
  }
  return *found;
}

// Every k-th index of 0 .. count-1, and the last.
std::vector<std::size_t> kept_indices(int count, int most) {
  const int step = std::max(1, (count - 2) / (most - 1) + 1);
  std::vector<std::size_t> kept;
  for (int i = 0; i < count - 1; i += step) kept.push_back(static_cast<std::size_t>(i));
  kept.push_back(static_cast<std::size_t>(count - 1));
  return kept;
}

// The difference quotient of the levels at point `at`, which is the k-th of the line of points with these coordinates
// and this stride; one-sided beside blanks, 0 where there are no neighbours.
double slope(const PictureField& field, const std::vector<double>& coordinates, std::size_t k, std::size_t at,
             std::size_t stride) {
  const bool before = k > 0 && !std::isnan(field.levels[at - stride]);
  const bool behind = k + 1 < coordinates.size() && !std::isnan(field.levels[at + stride]);
  if (!before && !behind) return 0;
  const double rise = field.levels[at + (behind ? stride : 0)] - field.levels[at - (before ? stride : 0)];
  return rise / (coordinates[k + behind] - coordinates[k - before]);
}

// Appends point (i, j) to the mesh.
void add_point(const PictureField& field, const SceneScale& scale, std::size_t i, std::size_t j, SceneMesh& mesh) {
  const std::size_t nx = field.x.size();
  const std::size_t at = i + j * nx;
  const bool blank = std::isnan(field.levels[at]);
  const float level = blank ? 0 : field.levels[at];
  const double dx = blank ? 0 : scale.height * slope(field, field.x, i, at, 1) / scale.factor[0];
  const double dy = blank ? 0 : scale.height * slope(field, field.y, j, at, nx) / scale.factor[1];
  const double length = std::sqrt(1 + dx * dx + dy * dy);
  for (const double c : {scale.x(field.x[i]), scale.y(field.y[j]), scale.height * level}) {
    mesh.points.push_back(static_cast<float>(c));
  }
  for (const double c : {-dx / length, -dy / length, 1 / length}) mesh.normals.push_back(static_cast<float>(c));
  mesh.levels.push_back(level);
}

// Point indices of the triangles of the cell with corners a, b (below) and c, d (above): all that have no blank corner.
// The cell is cut between the corners that differ less, so that mirror images look alike.
void add_cell(const std::array<int, 4>& corners, const std::vector<float>& levels, std::vector<int>& triangles) {
  const auto [a, b, c, d] = corners;
  const auto blank = [&](int point) { return std::isnan(levels[static_cast<std::size_t>(point)]); };
  const auto add = [&](int p, int q, int r) {
    if (!blank(p) && !blank(q) && !blank(r)) triangles.insert(triangles.end(), {p, q, r});
  };
  const auto difference = [&](int p, int q) {
    return std::abs(levels[static_cast<std::size_t>(p)] - levels[static_cast<std::size_t>(q)]);
  };
  if (blank(a) || blank(d) || difference(b, c) < difference(a, d)) {
    add(a, b, c);
    add(b, d, c);
  } else {
    add(a, b, d);
    add(a, d, c);
  }
}

}  // namespace

PictureField picture_field(const GridSamples& grid, const std::string& name, int most) {
  check_arrays(grid, "draw_picture");
  const PointArray& array = array_of(grid, name);
  if (grid.points[0] < 2 || grid.points[1] < 2)
    throw InvalidInput("draw_picture: the grid needs two points along each side");
  if (!(grid.spacing[0] > 0 && grid.spacing[1] > 0))
    throw InvalidInput("draw_picture: the grid's spacing must be positive");

  PictureField field;
  field.low = std::numeric_limits<double>::infinity();
  field.high = -field.low;
  for (const double value : array.values) {
    if (!std::isfinite(value)) continue;
    field.low = std::min(field.low, value);
    field.high = std::max(field.high, value);
  }
  if (!(field.low <= field.high)) throw InvalidInput("draw_picture: array '" + name + "' has no finite value");

  const std::vector<std::size_t> columns = kept_indices(grid.points[0], most);
  const std::vector<std::size_t> rows = kept_indices(grid.points[1], most);
  for (const std::size_t i : columns) field.x.push_back(grid.origin[0] + static_cast<double>(i) * grid.spacing[0]);
  for (const std::size_t j : rows) field.y.push_back(grid.origin[1] + static_cast<double>(j) * grid.spacing[1]);
  const double span = field.high - field.low;
  for (const std::size_t j : rows) {
    for (const std::size_t i : columns) {
      const double value = array.values[i + j * static_cast<std::size_t>(grid.points[0])];
      const double level = span > 0 ? (value - field.low) / span : 0.5 + 0 * value;
      field.levels.push_back(std::isfinite(level) ? static_cast<float>(level)
                                                  : std::numeric_limits<float>::quiet_NaN());
    }
  }
  return field;
}

SceneMesh scene_mesh(const PictureField& field, const SceneScale& scale) {
  SceneMesh mesh;
  const int nx = static_cast<int>(field.x.size());
  for (std::size_t j = 0; j < field.y.size(); ++j) {
    for (std::size_t i = 0; i < field.x.size(); ++i) add_point(field, scale, i, j, mesh);
  }
  for (int j = 0; j + 1 < static_cast<int>(field.y.size()); ++j) {
    for (int i = 0; i + 1 < nx; ++i) {
      const int a = i + j * nx;
      add_cell({a, a + 1, a + nx, a + nx + 1}, field.levels, mesh.triangles);
    }
  }
  return mesh;
}

}  // namespace batten
