// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/grid_arguments.h>
#include <batten/app/run_arguments.h>
#include <batten/app/smoothing_arguments.h>
#include <batten/fem/fit.h>

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace batten {

/// The command line of `batten fit`.
struct FitArguments {
  std::string points;  ///< the file, "-" for standard input
  std::string x, y, value, weight, tolerance_column;
  std::string energy = "thin-plate";
  std::optional<double> tension;
  int degree = 3;
  SmoothingArguments smoothing;
  std::optional<double> minimum, maximum;
  std::optional<double> aspect;
  bool geographic = false;
  GridArguments grid;
  bool skip_invalid = false;
  bool standard_error = false;
  std::optional<double> mask_distance;
  RunArguments run;
  std::string output, points_out, picture, report;
  std::string view = "surface";
};

/// Part of (1-T) thin plate + T membrane that --energy tension has if --tension does not say.
inline constexpr double default_tension = 0.9;

/// Lets `parser` fill `arguments` and gives it its help text. `arguments` must outlive the parser.
void add_fit_options(CLI::App& parser, FitArguments& arguments);

/// What CLI11 does not check: throws UsageError.
void check_arguments(const FitArguments& arguments);

Energy energy_of(const FitArguments& arguments);
/// T of the mixture that the energy is: 0 for the thin plate, 1 for the membrane.
double tension_of(const FitArguments& arguments);

}  // namespace batten
