// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/rectangle.h>
#include <batten/fem/fit.h>

#include <cstdint>
#include <optional>
#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace batten {

/// What the command line says about how close a fit comes to its data.
struct SmoothingArguments {
  std::string text = "auto";  ///< of --smoothing
  std::optional<double> tolerance;
  bool allow = false;
  std::uint64_t seed = 1;
};

/// What a fit makes of them.
struct SmoothingFound {
  double lambda = 0;
  bool tolerance_reached = true, no_interior_minimum = false;
  std::optional<double> least_tolerance;
};

/// Adds --smoothing, --tolerance (which it returns), --allow and --seed to a group; `arguments` must outlive the
/// parser.
CLI::Option* add_smoothing_options(CLI::App& parser, SmoothingArguments& arguments, const std::string& group);

/// Throws UsageError if --smoothing is neither auto, none nor a number >= 0.
Smoothing smoothing_of(const SmoothingArguments& arguments);

/// Whether the data are interpolated, or nearly so.
bool interpolates(const SmoothingArguments& arguments);

/// "lambda 1e-06 by cross-validation"
std::string smoothing_text(const SmoothingArguments& arguments, const SmoothingFound& found);

/// That the tolerance is not reachable on this grid, and which one is; `worst`: "line 7 at (1, 2), is 3 away".
std::string unreached_text(const SmoothingArguments& arguments, const SmoothingFound& found, const Rectangle& grid,
                           const std::string& worst);

/// Throws InvalidInput with the text of `unreached_text` if a tolerance has not been reached and that is not allowed.
void check_reached(const SmoothingArguments& arguments, const SmoothingFound& found, const std::string& unreached);

}  // namespace batten
