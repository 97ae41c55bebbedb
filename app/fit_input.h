// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/fit_arguments.h>
#include <batten/domains/rectangle.h>
#include <batten/fem/fit.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace batten {

/// The points of a table.
struct FitInput {
  Observations observations;
  std::array<std::string, 3> names;  ///< of the columns x, y, value
  std::vector<std::size_t> lines;    ///< of the file, for messages
  std::size_t skipped = 0;           ///< rows left out because of --skip-invalid
};

/// Throws IoError or InvalidInput, naming file, line and column.
FitInput read_fit_input(const FitArguments& arguments);

/// How many units of x one unit of y counts as: --aspect, or what --geographic makes of the latitudes.
/// Throws InvalidInput if these are no latitudes.
double aspect_of(const FitArguments& arguments, const Observations& observations);

/// The grid that the arguments ask for. Throws InvalidInput if it is none, or needs more memory than there is.
Rectangle grid_of(const FitArguments& arguments, const Observations& observations, double aspect);

/// "line 17 at (2.5, 3)": where observation i comes from.
std::string place_of(const FitInput& input, std::size_t i);

}  // namespace batten
