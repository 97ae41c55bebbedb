// SPDX-License-Identifier: MIT
#include <batten/app/grid_arguments.h>
#include <batten/app/option_checks.h>
#include <batten/app/usage_error.h>
#include <batten/domains/errors.h>
#include <batten/domains/grid_choice.h>
#include <batten/domains/number_text.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace batten {
namespace {

constexpr std::int64_t most_cells = 1 << 30;

// The cells as far as they are known before the grid is made, which for absurd numbers takes memory itself.
std::array<double, 2> expected_cells(const GridArguments& arguments, const GridData& data) {
  if (arguments.cells) {
    const auto [nx, ny] = *arguments.cells;
    return {static_cast<double>(nx), static_cast<double>(ny)};
  }
  if (!arguments.spacing) return {0, 0};
  const std::array<double, 4> box = box_of(arguments, data);
  return {std::ceil((box[1] - box[0]) / *arguments.spacing),
          std::ceil((box[3] - box[2]) * data.aspect / *arguments.spacing)};
}

void check_memory_of(FitSize size, std::array<double, 2> cells) {
  size.cells_x = cells[0];
  size.cells_y = cells[1];
  check_memory(size);
}

std::array<int, 2> as_integers(const std::array<std::int64_t, 2>& cells) {
  for (const std::int64_t n : cells) {
    if (n > most_cells) {
      throw InvalidInput("--cells: at most " + std::to_string(most_cells) + " on a side, found " + std::to_string(n));
    }
  }
  return {static_cast<int>(cells[0]), static_cast<int>(cells[1])};
}

}  // namespace

void add_grid_options(CLI::App& parser, GridArguments& a, const char* spacing_text) {
  const char* const group = "Grid";
  must_be_finite(parser.add_option("--region", a.region, "default: bounding box, widened by 5 % of its longer side"))
      ->option_text("XMIN XMAX YMIN YMAX")
      ->group(group);
  auto* const cells = parser.add_option("--cells", a.cells, "honoured exactly; default: about 256 on the longer side")
                          ->option_text("NX NY")
                          ->group(group);
  must_be_positive(parser.add_option("--spacing", a.spacing, spacing_text))
      ->option_text("H")
      ->excludes(cells)
      ->group(group);
}

void check_arguments(const GridArguments& arguments) {
  if (!arguments.cells) return;
  const auto [nx, ny] = *arguments.cells;
  if (nx < 2 || ny < 2) {
    throw UsageError("--cells: at least 2 x 2 are needed, found " + std::to_string(nx) + " x " + std::to_string(ny));
  }
}

std::array<double, 4> box_of(const GridArguments& arguments, const GridData& data) {
  if (arguments.region) return *arguments.region;
  const auto [xmin, xmax] = std::minmax_element(data.x.begin(), data.x.end());
  const auto [ymin, ymax] = std::minmax_element(data.y.begin(), data.y.end());
  return {*xmin, *xmax, *ymin, *ymax};
}

double geographic_aspect(const GridArguments& arguments, const GridData& data) {
  constexpr double pole = 90;
  const std::array<double, 4> box = box_of(arguments, data);
  const double south = box[2], north = box[3];
  if (south < -pole || north > pole) {
    throw InvalidInput("--geographic: latitudes (--y) must lie between -90 and 90 degrees, found " +
                       number_text(south, 6) + " to " + number_text(north, 6));
  }
  const double middle = (south + north) / 2;
  if (std::abs(middle) == pole)
    throw InvalidInput("--geographic: there is no longitude at a pole, found latitude " + number_text(middle));
  return 1 / std::cos(middle * std::numbers::pi / 180);
}

Rectangle grid_of(const GridArguments& arguments, const GridData& data, FitSize size) {
  check_memory_of(size, expected_cells(arguments, data));
  GridChoice choice;
  choice.region = arguments.region;
  choice.spacing = arguments.spacing;
  choice.aspect = data.aspect;
  if (arguments.cells) choice.cells = as_integers(*arguments.cells);
  const Rectangle grid = choose_grid(data.x, data.y, choice);
  check_memory_of(size, {static_cast<double>(grid.x.cells()), static_cast<double>(grid.y.cells())});
  return grid;
}

}  // namespace batten
