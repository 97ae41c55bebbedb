// SPDX-License-Identifier: MIT
#include <batten/app/flow_input.h>
#include <batten/app/table_source.h>
#include <batten/io/table.h>

#include <algorithm>
#include <utility>

namespace batten {

FlowInput read_flow_input(const FlowArguments& arguments) {
  TableOptions options{{arguments.x, arguments.y, arguments.u, arguments.v}, arguments.skip_invalid};
  if (!arguments.weight.empty()) options.columns.push_back(arguments.weight);
  Table table = read_table(arguments.vectors, options);
  FlowInput input;
  auto& [x, y, u, v, weight] = input.observations;
  x = std::move(table.columns[0]);
  y = std::move(table.columns[1]);
  u = std::move(table.columns[2]);
  v = std::move(table.columns[3]);
  if (!arguments.weight.empty()) weight = std::move(table.columns[4]);
  std::copy_n(table.names.begin(), input.names.size(), input.names.begin());
  input.lines = std::move(table.lines);
  input.skipped = table.skipped;
  check_weights(arguments.vectors, input.lines, weight);
  return input;
}

Rectangle grid_of(const FlowArguments& arguments, const VectorObservations& observations) {
  constexpr double rows_of_each = 2;  // slopes measured
  GridData data{observations.x, observations.y};
  if (arguments.geographic) data.aspect = geographic_aspect(arguments.grid, data);
  return grid_of(arguments.grid, data,
                 {.degree = arguments.degree,
                  .points = rows_of_each * static_cast<double>(observations.size()),
                  .interpolates = interpolates(arguments.smoothing),
                  .splines = model_of(arguments) == FlowModel::General ? 2 : 1});
}

std::string place_of(const FlowInput& input, std::size_t i) {
  return place_text(input.lines[i], input.observations.x[i], input.observations.y[i]);
}

}  // namespace batten
