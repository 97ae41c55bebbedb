// SPDX-License-Identifier: MIT
#include <batten/app/flow_arguments.h>
#include <batten/app/flow_help.h>
#include <batten/app/nearest_name.h>
#include <batten/app/option_checks.h>
#include <batten/app/usage_error.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>

namespace batten {
namespace {

constexpr int most_streamlines = 10000;

constexpr std::array<const char*, 4> model_names = {"smooth", "slow", "irrotational", "general"};
constexpr std::array<FlowModel, 4> models = {FlowModel::Smooth, FlowModel::Slow, FlowModel::Irrotational,
                                             FlowModel::General};

void add_input(CLI::App& parser, FlowArguments& a) {
  const char* const group = "Input";
  parser.add_option("VECTORS", a.vectors, "table of the vectors, with a header; - reads standard input")
      ->required()
      ->option_text(" ")
      ->group(group);
  const auto column = [&](const char* name, std::string& target, const char* text) {
    return parser.add_option(name, target, text)->option_text("COL")->group(group);
  };
  column("--x", a.x, "column of x: its name in the header or its number, from 1")->required();
  column("--y", a.y, "column of y, in the unit of x")->required();
  column("--u", a.u, "column of the velocity in x")->required();
  column("--v", a.v, "column of the velocity in y")->required();
  column("--weight", a.weight, "column of the weights w, >= 0; default: all 1");
  parser.add_flag("--skip-invalid", a.skip_invalid, "leave out and count the rows that cannot be read")->group(group);
  parser
      .add_flag("--geographic", a.geographic,
                "x is longitude, y latitude in degrees; u to the east, v to the north; lengths in km")
      ->group(group);
}

void add_field(CLI::App& parser, FlowArguments& a) {
  const char* const group = "Field";
  parser.add_option("--model", a.model, "smooth (default), slow, irrotational or general")
      ->option_text("NAME")
      ->group(group);
  must_be_positive(parser.add_option("--ratio", a.ratio, "R of --model general; default 1"))
      ->option_text("R")
      ->group(group);
  parser.add_option("--degree", a.degree, "degree of the B-splines: 3 (default), 4 or 5")
      ->option_text("D")
      ->check(CLI::IsMember({3, 4, 5}))
      ->group(group);
  add_side_options(parser, a.sides, group);
  auto* const tolerance = add_smoothing_options(parser, a.smoothing, group);
  parser.add_option("--tolerance-norm", a.tolerance_norm, "of E: component (default: of u and of v) or euclidean")
      ->option_text("NAME")
      ->check(CLI::IsMember({"component", "euclidean"}))
      ->needs(tolerance)
      ->group(group);
}

void add_output(CLI::App& parser, FlowArguments& a) {
  const char* const group = "Output";
  parser
      .add_option("-o,--output", a.output,
                  "velocity, divergence, vorticity, speed, stream_function, potential and coefficients")
      ->required()
      ->option_text("OUT.vti|OUT.vtu")
      ->group(group);
  parser.add_option("--points-out", a.points_out, "the vectors with velocity, fit, residual (fit - velocity), weight")
      ->option_text("OUT.vtp")
      ->group(group);
  auto* const count = parser.add_option("--streamlines", a.streamlines, "trace N streamlines, evenly spaced")
                          ->option_text("N")
                          ->check(CLI::Range(1, most_streamlines))
                          ->group(group);
  parser.add_option("--seeds", a.seeds, "trace those through the points of a table instead")
      ->option_text("POINTS.csv")
      ->excludes(count)
      ->group(group);
  parser
      .add_option("--parameter", a.parameter,
                  "points of streamlines at equal steps of length or time; default: the steps of the tracer")
      ->option_text("length|time")
      ->check(CLI::IsMember({"length", "time"}))
      ->group(group);
  parser.add_option("--streamlines-out", a.streamlines_out, "the streamlines with speed, time, length and vorticity")
      ->option_text("OUT.vtp")
      ->group(group);
  auto* const picture = parser.add_option("--picture", a.picture, "speed in colour under streamlines, or arrows")
                            ->option_text("OUT.png")
                            ->group(group);
  parser.add_option("--pixels", a.pixels, "size of the picture, default 1200 900")
      ->option_text("W H")
      ->check(CLI::Range(200, 16000))
      ->needs(picture)
      ->group(group);
  parser.add_option("--report", a.report, "numbers about the fit")->option_text("OUT.json")->group(group);
  add_run_options(parser, a.run, true);
}

}  // namespace

void add_flow_options(CLI::App& parser, FlowArguments& arguments) {
  add_input(parser, arguments);
  add_field(parser, arguments);
  add_grid_options(parser, arguments.grid, "square cells of size H in x; the region may grow at its upper ends");
  add_output(parser, arguments);
  parser.footer(flow_help);
}

void check_arguments(const FlowArguments& arguments) {
  const FlowModel model = model_of(arguments);
  if (arguments.ratio && model != FlowModel::General)
    throw UsageError("--ratio belongs to --model general, found --model " + arguments.model);
  const bool are_traced = arguments.streamlines || !arguments.seeds.empty();
  if (!arguments.streamlines_out.empty() && !are_traced)
    throw UsageError("--streamlines-out: say which streamlines, with --streamlines N or --seeds POINTS.csv");
  if (are_traced && arguments.streamlines_out.empty() && arguments.picture.empty())
    throw UsageError(std::string(arguments.streamlines ? "--streamlines" : "--seeds") +
                     ": say what for, with --streamlines-out OUT.vtp or --picture OUT.png");
  if (!arguments.parameter.empty() && arguments.streamlines_out.empty())
    throw UsageError("--parameter is for the points of --streamlines-out OUT.vtp, which is missing");
  check_arguments(arguments.grid);
  const FlowSides sides = sides_of(arguments.sides);
  if (model == FlowModel::General && sides.have(FlowSide::NoSlip) && !sides.have(FlowSide::Free))
    throw UsageError("--model general: expected a free side beside those of --no-slip, found none; take --walls");
  if (arguments.geographic && sides.bottom == FlowSide::Periodic)
    throw UsageError("--geographic: longitudes go around, latitudes do not; expected --periodic x, found --periodic " +
                     arguments.sides.periodic);
  if (model == FlowModel::Irrotational && arguments.sides.no_slip != "none")
    throw UsageError("--no-slip belongs to the models smooth, slow and general, found --model irrotational");
  smoothing_of(arguments.smoothing);
}

FlowModel model_of(const FlowArguments& arguments) {
  const auto found = std::find(model_names.begin(), model_names.end(), arguments.model);
  if (found == model_names.end())
    throw UsageError("--model: there is no model '" + arguments.model + "'; did you mean '" +
                     nearest_name(arguments.model, model_names) + "'? The models are " + name_list(model_names));
  return models[static_cast<std::size_t>(found - model_names.begin())];
}

}  // namespace batten
