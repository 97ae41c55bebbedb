// SPDX-License-Identifier: MIT
#include <batten/app/fit_arguments.h>
#include <batten/app/fit_command.h>
#include <batten/app/fit_input.h>
#include <batten/app/fit_outputs.h>
#include <batten/app/fit_report.h>
#include <batten/app/mask.h>
#include <batten/app/progress.h>
#include <batten/app/stopwatch.h>
#include <batten/app/thread_count.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/fit.h>

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>

namespace batten {
namespace {

FitOptions fit_options(const FitArguments& arguments, const FitInput& input, double aspect, Progress& progress) {
  FitOptions options;
  options.energy = energy_of(arguments);
  options.degree = arguments.degree;
  options.smoothing = smoothing_of(arguments.smoothing);
  options.minimum = arguments.minimum;
  options.maximum = arguments.maximum;
  options.aspect = aspect;
  options.standard_error = arguments.standard_error;
  options.seed = arguments.smoothing.seed;
  options.name_of = [&input](std::size_t i) { return "line " + std::to_string(input.lines[i]); };
  options.progress = [&progress](std::string_view phase, double done) { progress.show(phase, done); };
  return options;
}

std::string unreached_text(const FitArguments& arguments, const FitInput& input, const FitResult& result) {
  const std::size_t worst = result.worst_point;
  return unreached_text(arguments.smoothing, found_by(result), result.solution.region(),
                        place_of(input, worst) + ", is " +
                            number_text(std::abs(result.fitted[worst] - input.observations.value[worst])) + " away");
}

std::vector<std::string> warnings_of(const FitArguments& arguments, const FitInput& input, const FitResult& result) {
  std::vector<std::string> warnings;
  if (!result.tolerance_reached) warnings.push_back(unreached_text(arguments, input, result));
  return warnings;
}

GridSamples surface_samples(const FitResult& result, const std::vector<bool>& far) {
  GridSamples grid = result.solution.samples();
  if (!result.standard_error.empty()) grid.arrays.push_back({"standard_error", 1, result.standard_error});
  if (!far.empty()) blank(grid, far);
  return grid;
}

void print(const FitAccount& account) {
  const bool quiet = account.arguments->run.quiet;
  for (const std::string& text : account.warnings) std::cerr << "batten: warning: " << text << '\n';
  if (quiet) return;
  for (const std::string& text : account.notes) std::cerr << "batten: note: " << text << '\n';
  std::cout << summary_of(account) << std::flush;
}

void run_fit(const FitArguments& arguments) {
  check_arguments(arguments);
  check_outputs(arguments);
  set_thread_count(arguments.run.threads);
  Progress progress("batten fit", arguments.run.quiet);
  Stopwatch total, watch;

  progress.show("read");
  const FitInput input = read_fit_input(arguments);
  const double aspect = aspect_of(arguments, input.observations);
  const Rectangle region = grid_of(arguments, input.observations, aspect);
  std::vector<PhaseTime> seconds = {{"read", watch.lap()}};

  std::vector<bool> far;
  if (arguments.mask_distance) {
    progress.show("mask");
    far = far_corners(region, input.observations, *arguments.mask_distance, aspect);
    seconds.push_back({"mask", watch.lap()});
  }

  const FitResult result = fit_surface(input.observations, region, fit_options(arguments, input, aspect, progress));
  seconds.insert(seconds.end(), result.seconds.begin(), result.seconds.end());
  if (!result.tolerance_reached)
    check_reached(arguments.smoothing, found_by(result), unreached_text(arguments, input, result));

  watch.lap();
  write_outputs({&arguments, &input, &result, aspect, surface_samples(result, far)}, progress);
  seconds.push_back({"write", watch.lap()});
  seconds.push_back({"total", total.lap()});

  const FitAccount account{&arguments, &input, &result, result.notes, warnings_of(arguments, input, result), seconds};
  if (!arguments.report.empty()) write_report(arguments.report, account);
  progress.erase();
  print(account);
}

}  // namespace

Subcommand add_fit_command(CLI::App& app) {
  CLI::App* const parser = app.add_subcommand("fit", "Scattered data to the surface of least energy");
  const auto arguments = std::make_shared<FitArguments>();
  add_fit_options(*parser, *arguments);
  return {parser, [arguments] { run_fit(*arguments); }};
}

}  // namespace batten
