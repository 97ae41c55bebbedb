// SPDX-License-Identifier: MIT
#include <batten/app/fit_input.h>
#include <batten/app/memory_estimate.h>
#include <batten/domains/errors.h>
#include <batten/domains/grid_choice.h>
#include <batten/domains/number_text.h>
#include <batten/io/table.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace batten {
namespace {

constexpr double pole = 90;  // degrees of latitude
constexpr std::int64_t most_cells = 1 << 30;

std::string source_name(const FitArguments& arguments) {
  return arguments.points == "-" ? "standard input" : arguments.points;
}

// Throws InvalidInput with the line of the first value that is below 0, or is 0 where that is not allowed.
void check_column(const FitArguments& arguments, const FitInput& input, const std::vector<double>& values,
                  bool may_be_zero, const std::string& rule) {
  const auto wrong =
      std::find_if(values.begin(), values.end(), [&](double v) { return v < 0 || (v == 0 && !may_be_zero); });
  if (wrong == values.end()) return;
  const auto row = static_cast<std::size_t>(wrong - values.begin());
  throw InvalidInput(source_name(arguments) + ": line " + std::to_string(input.lines[row]) + ": " + rule + ", found " +
                     number_text(*wrong, 10));
}

// Least and largest of the coordinates.
std::array<double, 4> box_of(const FitArguments& arguments, const Observations& points) {
  if (arguments.region) return *arguments.region;
  const auto [xmin, xmax] = std::minmax_element(points.x.begin(), points.x.end());
  const auto [ymin, ymax] = std::minmax_element(points.y.begin(), points.y.end());
  return {*xmin, *xmax, *ymin, *ymax};
}

FitSize fit_size(const FitArguments& arguments, const Observations& points, double cells_x, double cells_y) {
  const Smoothing::Kind kind = smoothing_of(arguments).kind;
  const bool interpolates = kind == Smoothing::Kind::None || kind == Smoothing::Kind::Tolerance;
  return {cells_x, cells_y, arguments.degree, static_cast<double>(points.size()), interpolates};
}

// The size as far as it is known before the grid is made, which for absurd numbers takes memory itself.
FitSize expected_size(const FitArguments& arguments, const Observations& points, double aspect) {
  if (arguments.cells) {
    const auto [nx, ny] = *arguments.cells;
    return fit_size(arguments, points, static_cast<double>(nx), static_cast<double>(ny));
  }
  if (!arguments.spacing) return fit_size(arguments, points, 0, 0);
  const std::array<double, 4> box = box_of(arguments, points);
  return fit_size(arguments, points, std::ceil((box[1] - box[0]) / *arguments.spacing),
                  std::ceil((box[3] - box[2]) * aspect / *arguments.spacing));
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

FitInput read_fit_input(const FitArguments& arguments) {
  TableOptions options{{arguments.x, arguments.y, arguments.value}, arguments.skip_invalid};
  if (!arguments.weight.empty()) options.columns.push_back(arguments.weight);
  if (!arguments.tolerance_column.empty()) options.columns.push_back(arguments.tolerance_column);
  Table table = read_table(arguments.points, options);
  FitInput input;
  input.observations.x = std::move(table.columns[0]);
  input.observations.y = std::move(table.columns[1]);
  input.observations.value = std::move(table.columns[2]);
  if (!arguments.weight.empty()) input.observations.weight = std::move(table.columns[3]);
  if (!arguments.tolerance_column.empty()) input.observations.tolerance = std::move(table.columns.back());
  std::copy_n(table.names.begin(), input.names.size(), input.names.begin());
  input.lines = std::move(table.lines);
  input.skipped = table.skipped;
  check_column(arguments, input, input.observations.weight, true, "weights must not be negative");
  check_column(arguments, input, input.observations.tolerance, false, "tolerances must be positive");
  return input;
}

double aspect_of(const FitArguments& arguments, const Observations& observations) {
  if (!arguments.geographic) return arguments.aspect.value_or(1);
  const std::array<double, 4> box = box_of(arguments, observations);
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

Rectangle grid_of(const FitArguments& arguments, const Observations& observations, double aspect) {
  check_memory(expected_size(arguments, observations, aspect));
  GridChoice choice;
  choice.region = arguments.region;
  choice.spacing = arguments.spacing;
  choice.aspect = aspect;
  if (arguments.cells) choice.cells = as_integers(*arguments.cells);
  const Rectangle grid = choose_grid(observations.x, observations.y, choice);
  check_memory(fit_size(arguments, observations, grid.x.cells(), grid.y.cells()));
  return grid;
}

std::string place_of(const FitInput& input, std::size_t i) {
  return "line " + std::to_string(input.lines[i]) + " at (" + number_text(input.observations.x[i], 6) + ", " +
         number_text(input.observations.y[i], 6) + ")";
}

}  // namespace batten
