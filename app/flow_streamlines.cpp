// SPDX-License-Identifier: MIT
#include <batten/app/flow_streamlines.h>
#include <batten/app/point_columns.h>
#include <batten/app/table_source.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/flows/streamline_points.h>
#include <batten/io/table.h>

#include <utility>

namespace batten {

FlowSeeds read_seeds(const FlowArguments& arguments, const Rectangle& region) {
  if (arguments.seeds.empty()) return {};
  Table table = read_table(arguments.seeds, {point_columns(arguments.seeds), false});
  FlowSeeds seeds{std::move(table.columns[0]), std::move(table.columns[1]), std::move(table.lines)};
  for (std::size_t i = 0; i < seeds.x.size(); ++i) {
    if (region.contains(seeds.x[i], seeds.y[i])) continue;
    throw InvalidInput("--seeds: " + source_name(arguments.seeds) + ": the seed of " +
                       place_text(seeds.lines[i], seeds.x[i], seeds.y[i]) + " lies outside the region (x from " +
                       number_text(region.x.lower(), 6) + " to " + number_text(region.x.upper(), 6) + ", y from " +
                       number_text(region.y.lower(), 6) + " to " + number_text(region.y.upper(), 6) + ")");
  }
  return seeds;
}

std::vector<CurveSamples> streamlines_of(const FlowArguments& arguments, const FlowSeeds& seeds,
                                         const FlowField& field) {
  if (seeds.x.empty() && !arguments.streamlines) return {};
  const StreamlineTracer tracer(field);
  std::vector<Streamline> lines(seeds.x.size());
  const auto count = static_cast<std::ptrdiff_t>(lines.size());
#pragma omp parallel for schedule(dynamic)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    lines[k] = tracer.trace(seeds.x[k], seeds.y[k]);
  }
  if (arguments.streamlines) lines = tracer.evenly_spaced(*arguments.streamlines);
  if (!arguments.parameter.empty()) {
    const auto parameter = arguments.parameter == "time" ? StreamlineParameter::Time : StreamlineParameter::Length;
    const double step = fine_step(field, parameter);
    for (Streamline& line : lines) line = with_even_points(field, line, {.parameter = parameter, .step = step});
  }
  std::vector<CurveSamples> curves;
  for (const Streamline& line : lines) curves.push_back(samples_of(field, line));
  return curves;
}

}  // namespace batten
