// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/scheme_arguments.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace batten {

/// The command line of `batten subdivide`.
struct SubdivideArguments {
  std::string input;
  SchemeArguments scheme;
  int levels = 3;
  // Grids.
  std::string boundary;
  std::string rules = "exact";  ///< of bounded schemes
  std::optional<double> tension;
  // Flows.
  std::string kind, samples;
  std::optional<std::array<int, 2>> pixels;  ///< width and height of the picture
  // Curves.
  std::vector<std::string> columns;  ///< of the points; empty: x, y, z or the first ones
  std::string parameter = "uniform";
  bool closed = false;
  bool interpolate = false;
  std::optional<double> smoothing, tolerance;
  std::string tolerance_column;            ///< factors of the tolerance
  std::optional<double> minimum, maximum;  ///< of one column of values, everywhere
  bool limit = false;                      ///< of flows as well
  std::string show = "result";
  // What is written.
  std::string output, picture, view, report;
  int threads = 0;
  bool quiet = false;
};

}  // namespace batten
