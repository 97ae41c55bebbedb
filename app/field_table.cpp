// SPDX-License-Identifier: MIT
#include <batten/app/field_table.h>
#include <batten/domains/errors.h>
#include <batten/domains/grid_choice.h>
#include <batten/domains/number_text.h>
#include <batten/fem/fit.h>
#include <batten/io/table.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

namespace batten {
namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

std::vector<double> sorted_once(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// The position of v between grid lines: lines[i] + part * (lines[i + 1] - lines[i]). What rounding has put outside
/// lies on the end.
struct Position {
  std::size_t i;
  double part;
};

std::optional<Position> position_of(const std::vector<double>& lines, double v) {
  const double rounding = 1e-12 * (lines.back() - lines.front());
  if (!(v >= lines.front() - rounding && v <= lines.back() + rounding)) return std::nullopt;
  const auto above = std::upper_bound(lines.begin() + 1, lines.end() - 1, v);
  const auto i = static_cast<std::size_t>(above - lines.begin()) - 1;
  return Position{i, std::clamp((v - lines[i]) / (lines[i + 1] - lines[i]), 0., 1.)};
}

struct GridTable {
  std::vector<double> x, y, values;  // x fastest

  double operator()(double px, double py) const {
    const auto a = position_of(x, px), b = position_of(y, py);
    if (!a || !b) return not_there;
    const auto row = [&](std::size_t j) {
      const double* v = values.data() + j * x.size() + a->i;
      return std::lerp(v[0], v[1], a->part);
    };
    return std::lerp(row(b->i), row(b->i + 1), b->part);
  }
};

/// The grid that the points are, if they are one.
std::optional<GridTable> grid_of(const Table& table) {
  const auto &x = table.columns[0], &y = table.columns[1];
  GridTable grid{sorted_once(x), sorted_once(y), {}};
  if (grid.x.size() < 2 || grid.y.size() < 2 || grid.x.size() * grid.y.size() != x.size()) return std::nullopt;
  grid.values.assign(x.size(), not_there);
  for (std::size_t k = 0; k < x.size(); ++k) {
    const auto i = std::lower_bound(grid.x.begin(), grid.x.end(), x[k]) - grid.x.begin();
    const auto j = std::lower_bound(grid.y.begin(), grid.y.end(), y[k]) - grid.y.begin();
    double& value = grid.values[static_cast<std::size_t>(j) * grid.x.size() + static_cast<std::size_t>(i)];
    if (!std::isnan(value)) return std::nullopt;  // a point that is there twice leaves a gap elsewhere
    value = table.columns[2][k];
  }
  return grid;
}

Rectangle fitting_grid(const Table& table, const Rectangle& region) {
  const auto [xmin, xmax] = std::minmax_element(table.columns[0].begin(), table.columns[0].end());
  const auto [ymin, ymax] = std::minmax_element(table.columns[1].begin(), table.columns[1].end());
  GridChoice choice;
  choice.region = {std::min(*xmin, region.x.lower()), std::max(*xmax, region.x.upper()),
                   std::min(*ymin, region.y.lower()), std::max(*ymax, region.y.upper())};
  const auto& box = *choice.region;
  const double width = box[1] - box[0], height = box[3] - box[2], longer = std::max(width, height);
  const double distance = std::sqrt(width * height / static_cast<double>(table.columns[0].size()));
  choice.spacing = std::clamp(distance / 2, longer / 256, longer / 8);
  return choose_grid({}, {}, choice);
}

Field fitted(const std::filesystem::path& file, const Table& table, const Rectangle& region) {
  const Observations points{table.columns[0], table.columns[1], table.columns[2], {}, {}};
  try {
    const auto surface = std::make_shared<Solution>(fit_surface(points, fitting_grid(table, region)).solution);
    return Field([surface](double x, double y) { return surface->value(x, y); });
  } catch (const InvalidInput& error) {
    throw InvalidInput(file.string() + ": the points are no full grid and cannot be fitted: " + error.what());
  }
}

std::string range_text(const char* name, const std::vector<double>& lines) {
  return name + (" from " + number_text(lines.front(), 6)) + " to " + number_text(lines.back(), 6);
}

}  // namespace

TableField field_of_table(const std::filesystem::path& file, const Rectangle& region) {
  const Table table = read_table(file, {{"x", "y", "value"}, false});
  if (auto grid = grid_of(table)) {
    const std::string extent = range_text("x", grid->x) + ", " + range_text("y", grid->y);
    const auto shared = std::make_shared<const GridTable>(std::move(*grid));
    return {Field([shared](double x, double y) { return (*shared)(x, y); }), extent};
  }
  return {fitted(file, table, region), "everything"};
}

}  // namespace batten
