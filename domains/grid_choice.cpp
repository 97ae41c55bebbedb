// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/grid_choice.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace batten {
namespace {

constexpr double default_margin = 0.05;  // of the longer side
constexpr double default_cells = 256;    // on the longer side
constexpr int coarsest_cells = 8;
constexpr double most_cells = 1 << 29;

std::string number(double v) {
  std::string text = std::to_string(v);
  return text.erase(text.find_last_not_of('0') + 1);
}

std::array<double, 4> bounding_region(std::span<const double> x, std::span<const double> y, double aspect) {
  if (x.empty()) throw InvalidInput("choose_grid: expected at least one point or a region, found neither");
  const auto [xmin, xmax] = std::minmax_element(x.begin(), x.end());
  const auto [ymin, ymax] = std::minmax_element(y.begin(), y.end());
  double side = std::max(*xmax - *xmin, (*ymax - *ymin) * aspect);
  if (side == 0) side = 1;
  const double margin = default_margin * side;
  return {*xmin - margin, *xmax + margin, *ymin - margin / aspect, *ymax + margin / aspect};
}

void check_region(const std::array<double, 4>& r) {
  for (double v : r)
    if (!std::isfinite(v)) throw InvalidInput("region: expected finite numbers, found " + std::to_string(v));
  if (!(r[0] < r[1]) || !(r[2] < r[3]))
    throw InvalidInput("region: expected xmin < xmax and ymin < ymax, found x from " + number(r[0]) + " to " +
                       number(r[1]) + ", y from " + number(r[2]) + " to " + number(r[3]));
}

/// Cells of length h that cover `length`, a multiple of `unit`.
int covering_cells(double length, double h, int unit) {
  const auto cells = static_cast<int>(std::ceil(length / h * (1 - 1e-9) / unit) * unit);
  return std::max(cells, std::max(unit, 2));
}

}  // namespace

Rectangle choose_grid(std::span<const double> x, std::span<const double> y, const GridChoice& choice) {
  if (!(choice.aspect > 0) || !std::isfinite(choice.aspect))
    throw InvalidInput("aspect: expected a positive number, found " + number(choice.aspect));
  const auto r = choice.region ? *choice.region : bounding_region(x, y, choice.aspect);
  check_region(r);
  if (choice.cells) {
    const auto [nx, ny] = *choice.cells;
    if (nx < 2 || ny < 2)
      throw InvalidInput("cells: expected at least 2 x 2, found " + std::to_string(nx) + " x " + std::to_string(ny));
    return {Interval(r[0], r[1], nx), Interval(r[2], r[3], ny)};
  }
  const double width = r[1] - r[0], height = (r[3] - r[2]) * choice.aspect, longer = std::max(width, height);
  const double h = choice.spacing ? *choice.spacing : longer / default_cells;
  if (!(h > 0) || !std::isfinite(h)) throw InvalidInput("spacing: expected a positive number, found " + number(h));
  if (!(longer / h < most_cells))
    throw InvalidInput("spacing: expected at most " + number(most_cells) + " cells on a side, found " +
                       number(longer / h));
  int unit = 1;  // 2^k with at most 8 cells left on the longer side
  while (std::ceil(longer / h * (1 - 1e-9) / unit) > coarsest_cells) unit *= 2;
  const double shorter = std::min(width, height) / h;
  int short_unit = unit;  // a thin strip is not widened beyond its next even number of cells
  while (short_unit > 2 && short_unit > shorter) short_unit /= 2;
  const bool wide = width >= height;
  const int nx = covering_cells(width, h, wide ? unit : short_unit);
  const int ny = covering_cells(height, h, wide ? short_unit : unit);
  return {Interval(r[0], std::max(r[1], r[0] + nx * h), nx),
          Interval(r[2], std::max(r[3], r[2] + ny * h / choice.aspect), ny)};
}

}  // namespace batten
