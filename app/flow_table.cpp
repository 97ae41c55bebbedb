// SPDX-License-Identifier: MIT
#include <batten/app/flow_table.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/io/table.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace batten {
namespace {

constexpr double tolerance = 1e-6;  // of the spacing, for decimals that were rounded

/// first, first + step, ..., `points` of them.
struct EvenSteps {
  double first = 0, step = 0;
  int points = 1;

  double at(int i) const { return first + i * step; }
  /// The number of the point there, -1 when there is none.
  int index_of(double x) const {
    const double i = std::round((x - first) / step);
    return i >= 0 && i < points && std::abs(x - at(static_cast<int>(i))) <= tolerance * step ? static_cast<int>(i) : -1;
  }
};

std::string point_text(double x, double y) {
  return std::string("(") + number_text(x, 9) + ", " + number_text(y, 9) + ")";
}

/// The steps between the least and the greatest coordinate, as many as different coordinates say.
EvenSteps steps_of(std::vector<double> values, const std::string& file, const std::string& column) {
  std::sort(values.begin(), values.end());
  const double range = values.back() - values.front();
  EvenSteps steps{values.front()};
  for (std::size_t k = 1; k < values.size(); ++k)
    if (values[k] - values[k - 1] > 1e-9 * range) ++steps.points;
  if (steps.points < 2)
    throw InvalidInput(file + ": a grid of 2 x 2 points or more is needed, all points have " + column + " = " +
                       number_text(values.front(), 9));
  steps.step = range / (steps.points - 1);
  return steps;
}

/// The columns behind x and y at the points of the grid.
ControlGrid grid_of(const Table& table, const std::string& file) {
  const EvenSteps x = steps_of(table.columns[0], file, "x"), y = steps_of(table.columns[1], file, "y");
  const std::size_t rows = table.lines.size();
  if (static_cast<std::size_t>(x.points) * static_cast<std::size_t>(y.points) > 2 * rows + 100)
    throw InvalidInput(file + ": the points must form a grid, found " + std::to_string(x.points) + " different x and " +
                       std::to_string(y.points) + " different y of " + std::to_string(rows) + " points");
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  ControlGrid grid{.components = {table.columns.size() - 2, Eigen::MatrixXd::Constant(x.points, y.points, unknown)},
                   .start = {x.first, y.first},
                   .spacing = {x.step, y.step}};
  const std::string shape = "a grid of " + std::to_string(x.points) + " x " + std::to_string(y.points) + " points";
  for (std::size_t row = 0; row < rows; ++row) {
    const double at_x = table.columns[0][row], at_y = table.columns[1][row];
    const int i = x.index_of(at_x), j = y.index_of(at_y);
    const std::string place =
        file + ", line " + std::to_string(table.lines[row]) + ": the point " + point_text(at_x, at_y);
    if (i < 0 || j < 0) throw InvalidInput(place + " is off " + shape + " at equal distances");
    if (!std::isnan(grid.components[0](i, j))) throw InvalidInput(place + " is given twice");
    for (std::size_t k = 0; k < grid.components.size(); ++k) grid.components[k](i, j) = table.columns[2 + k][row];
  }
  for (int j = 0; j < y.points; ++j)
    for (int i = 0; i < x.points; ++i)
      if (std::isnan(grid.components[0](i, j)))
        throw InvalidInput(file + ": of " + shape + " the point " + point_text(x.at(i), y.at(j)) + " is missing");
  return grid;
}

/// The grid of a table with these columns behind x and y.
ControlGrid read_grid(const std::string& file, const std::vector<std::string>& names) {
  std::vector<std::string> columns = {"x", "y"};
  columns.insert(columns.end(), names.begin(), names.end());
  ControlGrid grid = grid_of(read_table(file, {.columns = columns}), file);
  const auto [hx, hy] = grid.spacing;
  if (std::abs(hx - hy) > tolerance * hx)
    throw InvalidInput(file + ": cells must be square, found steps of " + number_text(hx, 6) + " in x and " +
                       number_text(hy, 6) + " in y");
  grid.spacing[1] = hx;
  return grid;
}

}  // namespace

StaggeredField read_flow(const std::string& file, FlowSamples samples) {
  const ControlGrid grid = read_grid(file, {"u", "v"});
  if (samples == FlowSamples::Vertices) return from_vertices(grid);
  const Eigen::MatrixXd &u = grid.components[0], &v = grid.components[1];
  return {u.leftCols(u.cols() - 1), v.topRows(v.rows() - 1), grid.start, grid.spacing[0]};
}

ControlGrid read_rotors(const std::string& file) { return read_grid(file, {"rotation"}); }

}  // namespace batten
