// SPDX-License-Identifier: MIT
#include <batten/app/flow_arguments.h>
#include <batten/app/flow_command.h>
#include <batten/app/flow_input.h>
#include <batten/app/flow_outputs.h>
#include <batten/app/flow_report.h>
#include <batten/app/flow_streamlines.h>
#include <batten/app/progress.h>
#include <batten/app/stopwatch.h>
#include <batten/app/thread_count.h>
#include <batten/domains/number_text.h>

#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>
#include <memory>

namespace batten {
namespace {

FlowOptions flow_options(const FlowArguments& arguments, const FlowInput& input, Progress& progress) {
  FlowOptions options;
  options.model = model_of(arguments);
  options.ratio = arguments.ratio.value_or(1);
  options.geographic = arguments.geographic;
  options.sides = sides_of(arguments.sides);
  options.degree = arguments.degree;
  options.smoothing = smoothing_of(arguments.smoothing);
  if (arguments.tolerance_norm == "euclidean") options.tolerance_norm = ToleranceNorm::Euclidean;
  options.name_of = [&input](std::size_t i) { return "line " + std::to_string(input.lines[i]); };
  options.seed = arguments.smoothing.seed;
  options.progress = [&progress](std::string_view phase, double done) { progress.show(phase, done); };
  return options;
}

std::string unreached_text(const FlowArguments& arguments, const FlowInput& input, const FlowResult& result) {
  return unreached_text(arguments.smoothing, found_by(result), result.field.region(),
                        place_of(input, result.worst_point) + ", is " + number_text(result.largest_residual) + " away");
}

std::string fewer_lines_text(const FlowArguments& arguments, std::size_t found) {
  if (found >= static_cast<std::size_t>(arguments.streamlines.value_or(0))) return {};
  return "only " + std::to_string(found) + " of " + std::to_string(*arguments.streamlines) +
         " streamlines were found: they pass through all of 64 x 64 places";
}

void print(const FlowAccount& account) {
  for (const std::string& text : account.warnings) std::cerr << "batten: warning: " << text << '\n';
  if (account.arguments->run.quiet) return;
  for (const std::string& text : account.notes) std::cerr << "batten: note: " << text << '\n';
  std::cout << summary_of(account) << std::flush;
}

void run_flow(const FlowArguments& arguments) {
  check_arguments(arguments);
  check_outputs(arguments);
  set_thread_count(arguments.run.threads);
  Progress progress("batten flow", arguments.run.quiet);
  Stopwatch total, watch;

  progress.show("read");
  const FlowInput input = read_flow_input(arguments);
  const Rectangle region = grid_of(arguments, input.observations);
  const FlowSeeds seeds = read_seeds(arguments, region);
  FlowAccount account{.arguments = &arguments, .input = &input};
  account.seconds = {{"read", watch.lap()}};

  const FlowResult result = fit_flow(input.observations, region, flow_options(arguments, input, progress));
  account.result = &result;
  account.notes = result.notes;
  account.seconds.insert(account.seconds.end(), result.seconds.begin(), result.seconds.end());
  if (!result.tolerance_reached) {
    account.warnings.push_back(unreached_text(arguments, input, result));
    check_reached(arguments.smoothing, found_by(result), account.warnings.back());
  }

  watch.lap();
  if (arguments.streamlines || !seeds.x.empty()) progress.show("streamlines");
  const FlowOutputs outputs{&arguments, &input, &result, streamlines_of(arguments, seeds, result.field)};
  account.streamlines = outputs.streamlines.size();
  account.seconds.push_back({"streamlines", watch.lap()});
  const std::string fewer = fewer_lines_text(arguments, account.streamlines);
  if (!fewer.empty()) account.notes.push_back(fewer);
  write_outputs(outputs, progress);
  account.seconds.push_back({"write", watch.lap()});
  account.seconds.push_back({"total", total.lap()});
  if (!arguments.report.empty()) write_report(account);
  progress.erase();
  print(account);
}

}  // namespace

Subcommand add_flow_command(CLI::App& app) {
  CLI::App* const parser = app.add_subcommand("flow", "Measured vectors to the vector field of least energy");
  const auto arguments = std::make_shared<FlowArguments>();
  add_flow_options(*parser, *arguments);
  return {parser, [arguments] { run_flow(*arguments); }};
}

}  // namespace batten
