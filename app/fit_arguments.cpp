// SPDX-License-Identifier: MIT
#include <batten/app/fit_arguments.h>
#include <batten/app/fit_help.h>
#include <batten/app/option_checks.h>
#include <batten/app/usage_error.h>
#include <batten/domains/number_text.h>

#include <CLI/CLI.hpp>

namespace batten {
namespace {

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
  auto* const aspect =
      must_be_positive(parser.add_option("--aspect", a.aspect, "one unit of y counts as R units of x; default 1"))
          ->option_text("R")
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
  must_be_fraction(parser.add_option("--tension", a.tension, "T of --energy tension, from 0 to 1; default 0.9"))
      ->option_text("T")
      ->group(group);
  parser.add_option("--degree", a.degree, "degree of the B-splines: 3 (default) or 2")
      ->option_text("D")
      ->check(CLI::IsMember({2, 3}))
      ->group(group);
  auto* const tolerance = add_smoothing_options(parser, a.smoothing, group);
  parser.add_option("--tolerance-column", a.tolerance_column, "column of a tolerance for each point, times E")
      ->option_text("COL")
      ->needs(tolerance)
      ->group(group);
  must_be_finite(parser.add_option("--minimum", a.minimum, "the surface is nowhere below V"))
      ->option_text("V")
      ->group(group);
  must_be_finite(parser.add_option("--maximum", a.maximum, "the surface is nowhere above V"))
      ->option_text("V")
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
  must_be_positive(parser.add_option("--mask-distance", a.mask_distance,
                                     "blank what is farther than D (in units of x) from any point"))
      ->option_text("D")
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
  add_run_options(parser, a.run, true);
}

}  // namespace

void add_fit_options(CLI::App& parser, FitArguments& arguments) {
  add_input(parser, arguments);
  add_surface(parser, arguments);
  add_grid_options(parser, arguments.grid, "cells of size H in x and H/R in y; the region may grow at its upper ends");
  add_output(parser, arguments);
  parser.footer(fit_help);
}

void check_arguments(const FitArguments& arguments) {
  if (arguments.tension && arguments.energy != "tension") {
    throw UsageError("--tension belongs to --energy tension, found --energy " + arguments.energy);
  }
  if (arguments.minimum && arguments.maximum && *arguments.minimum >= *arguments.maximum)
    throw UsageError("--minimum must be below --maximum, found " + number_text(*arguments.minimum) + " and " +
                     number_text(*arguments.maximum));
  check_arguments(arguments.grid);
  smoothing_of(arguments.smoothing);
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

}  // namespace batten
