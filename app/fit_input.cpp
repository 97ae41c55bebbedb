// SPDX-License-Identifier: MIT
#include <batten/app/fit_input.h>
#include <batten/app/table_source.h>
#include <batten/io/table.h>

#include <algorithm>

namespace batten {
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
  check_weights(arguments.points, input.lines, input.observations.weight);
  check_tolerances(arguments.points, input.lines, input.observations.tolerance);
  return input;
}

double aspect_of(const FitArguments& arguments, const Observations& observations) {
  if (!arguments.geographic) return arguments.aspect.value_or(1);
  return geographic_aspect(arguments.grid, {observations.x, observations.y});
}

Rectangle grid_of(const FitArguments& arguments, const Observations& observations, double aspect) {
  return grid_of(arguments.grid, {observations.x, observations.y, aspect},
                 {.degree = arguments.degree,
                  .points = static_cast<double>(observations.size()),
                  .interpolates = interpolates(arguments.smoothing)});
}

std::string place_of(const FitInput& input, std::size_t i) {
  return place_text(input.lines[i], input.observations.x[i], input.observations.y[i]);
}

}  // namespace batten
