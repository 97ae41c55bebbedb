// SPDX-License-Identifier: MIT
#include <batten/app/fit_arguments.h>
#include <batten/app/fit_help.h>
#include <batten/app/thread_count.h>
#include <batten/app/usage_error.h>

#include <CLI/CLI.hpp>

#include <charconv>
#include <cmath>
#include <concepts>
#include <optional>

namespace batten {
namespace {

std::optional<double> finite_number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

// Accepts the numbers that `test` does, and says of all others that they are not `what`.
template <std::predicate<double> Test>
CLI::Validator number_that(Test test, const std::string& what) {
  const auto check = [test, what](const std::string& text) {
    const std::optional<double> value = finite_number(text);
    return value && test(*value) ? std::string() : "'" + text + "' is not " + what;
  };
  return CLI::Validator(check, "");
}

const CLI::Validator finite = number_that([](double) { return true; }, "a finite number");
const CLI::Validator positive = number_that([](double v) { return v > 0; }, "a positive number");
const CLI::Validator fraction = number_that([](double v) { return v >= 0 && v <= 1; }, "a number from 0 to 1");

// CLI11 reads "-1" as a large unsigned number.
const CLI::Validator digits(
    [](const std::string& text) {
      if (text.find_first_not_of("0123456789") == std::string::npos) return std::string();
      return "'" + text + "' is not a whole number >= 0";
    },
    "");

void add_input(CLI::App& parser, FitArguments& a) {
  const char* const group = "Input";
  parser.add_option("POINTS", a.points, "table of the points, with a header; - reads standard input")
      ->required()
      ->option_text(" ")
      ->group(group);
  const auto column = [&](const char* name, std::string& target, const char* text) {
    return parser.add_option(name, target, text)->option_text("COL")->group(group);
  };
  column("--x", a.x, "column of x: its name in the header or its number, from 1")->required();
  column("--y", a.y, "column of y")->required();
  column("--value", a.value, "column of the values z")->required();
  column("--weight", a.weight, "column of the weights w, >= 0; default: all 1");
  parser.add_flag("--skip-invalid", a.skip_invalid, "leave out and count the rows that cannot be read")->group(group);
  auto* const aspect = parser.add_option("--aspect", a.aspect, "one unit of y counts as R units of x; default 1")
                           ->option_text("R")
                           ->check(positive)
                           ->group(group);
  parser.add_flag("--geographic", a.geographic, "x is longitude, y latitude: R = 1/cos of the mid latitude")
      ->excludes(aspect)
      ->group(group);
}

void add_surface(CLI::App& parser, FitArguments& a) {
  const char* const group = "Surface";
  parser.add_option("--energy", a.energy, "thin-plate (default), membrane or tension")
      ->option_text("NAME")
      ->check(CLI::IsMember({"thin-plate", "membrane", "tension"}))
      ->group(group);
  parser.add_option("--tension", a.tension, "T of --energy tension, from 0 to 1; default 0.9")
      ->option_text("T")
      ->check(fraction)
      ->group(group);
  parser.add_option("--degree", a.degree, "degree of the B-splines: 3 (default) or 2")
      ->option_text("D")
      ->check(CLI::IsMember({2, 3}))
      ->group(group);
  auto* const smoothing = parser.add_option("--smoothing", a.smoothing, "auto (default), LAMBDA or none")
                              ->option_text("LAMBDA")
                              ->group(group);
  auto* const tolerance = parser.add_option("--tolerance", a.tolerance, "stay within E of every point instead")
                              ->option_text("E")
                              ->check(positive)
                              ->excludes(smoothing)
                              ->group(group);
  parser.add_option("--tolerance-column", a.tolerance_column, "column of a tolerance for each point, times E")
      ->option_text("COL")
      ->needs(tolerance)
      ->group(group);
  parser.add_flag("--allow", a.allow, "write the surface even if the tolerance is not reached")
      ->needs(tolerance)
      ->group(group);
  parser.add_option("--seed", a.seed, "of the random probes of cross-validation and standard error; default 1")
      ->option_text("N")
      ->check(digits)
      ->group(group);
}

void add_grid(CLI::App& parser, FitArguments& a) {
  const char* const group = "Grid";
  parser.add_option("--region", a.region, "default: bounding box, widened by 5 % of its longer side")
      ->option_text("XMIN XMAX YMIN YMAX")
      ->check(finite)
      ->group(group);
  auto* const cells = parser.add_option("--cells", a.cells, "honoured exactly; default: about 256 on the longer side")
                          ->option_text("NX NY")
                          ->group(group);
  parser.add_option("--spacing", a.spacing, "cells of size H in x and H/R in y; the region may grow at its upper ends")
      ->option_text("H")
      ->check(positive)
      ->excludes(cells)
      ->group(group);
}

void add_output(CLI::App& parser, FitArguments& a) {
  const char* const group = "Output";
  parser
      .add_option("-o,--output", a.output,
                  "the surface: OUT.vti (with gradient and coefficients) or OUT.csv (x,y,value)")
      ->required()
      ->option_text("OUT")
      ->group(group);
  parser.add_flag("--standard-error", a.standard_error, "add the array standard_error")->group(group);
  parser.add_option("--mask-distance", a.mask_distance, "blank what is farther than D (in units of x) from any point")
      ->option_text("D")
      ->check(positive)
      ->group(group);
  parser.add_option("--points-out", a.points_out, "the points with value, fit, residual (fit - value), weight")
      ->option_text("OUT.vtp")
      ->group(group);
  auto* const picture =
      parser.add_option("--picture", a.picture, "a picture of the surface")->option_text("OUT.png")->group(group);
  parser.add_option("--view", a.view, "of the picture: surface (default) or map")
      ->option_text("VIEW")
      ->check(CLI::IsMember({"surface", "map"}))
      ->needs(picture)
      ->group(group);
  parser.add_option("--report", a.report, "numbers about the fit")->option_text("OUT.json")->group(group);
  parser.add_option("--threads", a.threads, "default: all of the machine; the result does not depend on it")
      ->option_text("N")
      ->check(CLI::Range(1, most_threads))
      ->group(group);
  parser.add_flag("--quiet", a.quiet, "print errors only")->group(group);
}

}  // namespace

void add_fit_options(CLI::App& parser, FitArguments& arguments) {
  add_input(parser, arguments);
  add_surface(parser, arguments);
  add_grid(parser, arguments);
  add_output(parser, arguments);
  parser.footer(fit_help);
}

void check_arguments(const FitArguments& arguments) {
  if (arguments.tension && arguments.energy != "tension") {
    throw UsageError("--tension belongs to --energy tension, found --energy " + arguments.energy);
  }
  if (arguments.cells) {
    const auto [nx, ny] = *arguments.cells;
    if (nx < 2 || ny < 2) {
      throw UsageError("--cells: at least 2 x 2 are needed, found " + std::to_string(nx) + " x " + std::to_string(ny));
    }
  }
  smoothing_of(arguments);
}

Energy energy_of(const FitArguments& arguments) {
  if (arguments.energy == "membrane") return Energy::membrane();
  if (arguments.energy == "tension") return Energy::tension(tension_of(arguments));
  return Energy::thin_plate();
}

double tension_of(const FitArguments& arguments) {
  if (arguments.energy == "tension") return arguments.tension.value_or(default_tension);
  return arguments.energy == "membrane" ? 1 : 0;
}

Smoothing smoothing_of(const FitArguments& arguments) {
  if (arguments.tolerance) return Smoothing::within(*arguments.tolerance);
  const std::string& text = arguments.smoothing;
  if (text == "auto") return Smoothing::automatic();
  if (text == "none") return Smoothing::none();
  const std::optional<double> lambda = finite_number(text);
  if (!lambda || *lambda < 0) {
    throw UsageError("--smoothing: '" + text + "' is neither auto nor none nor a number >= 0");
  }
  return *lambda == 0 ? Smoothing::none() : Smoothing::fixed(*lambda);
}

}  // namespace batten
