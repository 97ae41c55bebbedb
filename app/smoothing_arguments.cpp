// SPDX-License-Identifier: MIT
#include <batten/app/option_checks.h>
#include <batten/app/smoothing_arguments.h>
#include <batten/app/usage_error.h>
#include <batten/domains/number_text.h>

#include <CLI/CLI.hpp>

namespace batten {

CLI::Option* add_smoothing_options(CLI::App& parser, SmoothingArguments& a, const std::string& group) {
  auto* const smoothing =
      parser.add_option("--smoothing", a.text, "auto (default), LAMBDA or none")->option_text("LAMBDA")->group(group);
  auto* const tolerance =
      must_be_positive(parser.add_option("--tolerance", a.tolerance, "stay within E of every point instead"))
          ->option_text("E")
          ->excludes(smoothing)
          ->group(group);
  parser.add_flag("--allow", a.allow, "write the result even if the tolerance is not reached")
      ->needs(tolerance)
      ->group(group);
  must_be_whole(parser.add_option("--seed", a.seed, "of the random probes; default 1"))->option_text("N")->group(group);
  return tolerance;
}

Smoothing smoothing_of(const SmoothingArguments& arguments) {
  if (arguments.tolerance) return Smoothing::within(*arguments.tolerance);
  const std::string& text = arguments.text;
  if (text == "auto") return Smoothing::automatic();
  if (text == "none") return Smoothing::none();
  const std::optional<double> lambda = finite_number(text);
  if (!lambda || *lambda < 0) {
    throw UsageError("--smoothing: '" + text + "' is neither auto nor none nor a number >= 0");
  }
  return *lambda == 0 ? Smoothing::none() : Smoothing::fixed(*lambda);
}

bool interpolates(const SmoothingArguments& arguments) {
  const Smoothing::Kind kind = smoothing_of(arguments).kind;
  return kind == Smoothing::Kind::None || kind == Smoothing::Kind::Tolerance;
}

std::string smoothing_text(const SmoothingArguments& arguments, const SmoothingFound& found) {
  const Smoothing smoothing = smoothing_of(arguments);
  switch (smoothing.kind) {
    case Smoothing::Kind::Tolerance:
      return "within " + number_text(smoothing.value) + (found.tolerance_reached ? "" : " (not reached)");
    case Smoothing::Kind::None:
      return found.lambda > 0 ? "lambda " + number_text(found.lambda) : "no smoothing";
    case Smoothing::Kind::Automatic:
      return "lambda " + number_text(found.lambda) + " by cross-validation" +
             (found.no_interior_minimum ? " (no interior minimum)" : "");
    case Smoothing::Kind::Fixed:
      break;
  }
  return "lambda " + number_text(found.lambda);
}

std::string unreached_text(const SmoothingArguments& arguments, const SmoothingFound& found, const Rectangle& grid,
                           const std::string& worst) {
  constexpr int digits = 5;
  const std::string least = found.least_tolerance
                                ? ", and the least that is reachable is " + number_text(*found.least_tolerance, digits)
                                : "";
  return "the tolerance " + number_text(arguments.tolerance.value_or(0)) + " is not reachable on this grid of " +
         std::to_string(grid.x.cells()) + " x " + std::to_string(grid.y.cells()) + " cells: the worst point, " + worst +
         least;
}

void check_reached(const SmoothingArguments& arguments, const SmoothingFound& found, const std::string& unreached) {
  if (found.tolerance_reached || arguments.allow) return;
  throw InvalidInput(unreached + "; nothing is written; take more cells, or --allow to write it nevertheless");
}

}  // namespace batten
