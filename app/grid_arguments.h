// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/memory_estimate.h>
#include <batten/domains/rectangle.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace CLI {
class App;
}

namespace batten {

/// What the command line says about the grid of a fit.
struct GridArguments {
  std::optional<std::array<double, 4>> region;
  std::optional<std::array<std::int64_t, 2>> cells;
  std::optional<double> spacing;
};

/// Where the data lie, and how many units of x one unit of y counts as.
struct GridData {
  std::span<const double> x, y;
  double aspect = 1;
};

/// Adds --region, --cells and --spacing; `spacing_text` explains the last. `arguments` must outlive the parser.
void add_grid_options(CLI::App& parser, GridArguments& arguments, const char* spacing_text);

/// What CLI11 does not check: throws UsageError.
void check_arguments(const GridArguments& arguments);

/// xmin, xmax, ymin, ymax: of --region, or the least and largest coordinates.
std::array<double, 4> box_of(const GridArguments& arguments, const GridData& data);

/// How many units of x one unit of y counts as where x is the longitude and y the latitude: 1 / cos of the mid
/// latitude. Throws InvalidInput for latitudes that are none.
double geographic_aspect(const GridArguments& arguments, const GridData& data);

/// The grid that the arguments ask for. Throws InvalidInput if it is none, or if a fit of this size (its cells are set
/// here) needs more memory than there is.
Rectangle grid_of(const GridArguments& arguments, const GridData& data, FitSize size);

}  // namespace batten
