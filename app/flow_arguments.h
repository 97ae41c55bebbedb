// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/flow_side_arguments.h>
#include <batten/app/grid_arguments.h>
#include <batten/app/run_arguments.h>
#include <batten/app/smoothing_arguments.h>
#include <batten/flows/flow_fit.h>

#include <array>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace batten {

/// The command line of `batten flow`.
struct FlowArguments {
  std::string vectors;  ///< the file, "-" for standard input
  std::string x, y, u, v, weight;
  bool skip_invalid = false;
  bool geographic = false;
  std::string model = "smooth";
  std::optional<double> ratio;
  int degree = 3;
  FlowSideArguments sides;
  SmoothingArguments smoothing;
  std::string tolerance_norm = "component";
  GridArguments grid;
  std::optional<int> streamlines;
  std::string seeds, parameter;
  std::string output, points_out, streamlines_out, picture, report;
  std::optional<std::array<int, 2>> pixels;  ///< width and height of the picture
  RunArguments run;
};

/// Lets `parser` fill `arguments` and gives it its help text. `arguments` must outlive the parser.
void add_flow_options(CLI::App& parser, FlowArguments& arguments);

/// What CLI11 does not check: throws UsageError.
void check_arguments(const FlowArguments& arguments);

/// Throws UsageError, with the nearest name, if there is no such model.
FlowModel model_of(const FlowArguments& arguments);

}  // namespace batten
