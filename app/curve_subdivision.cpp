// SPDX-License-Identifier: MIT
#include <batten/app/curve_input.h>
#include <batten/app/curve_pictures.h>
#include <batten/app/curve_report.h>
#include <batten/app/curve_subdivision.h>
#include <batten/app/fitted_curve.h>
#include <batten/app/output_names.h>
#include <batten/app/progress.h>
#include <batten/app/scheme_catalogue.h>
#include <batten/app/stopwatch.h>
#include <batten/app/usage_error.h>
#include <batten/bases/subdivide.h>
#include <batten/domains/number_text.h>
#include <batten/io/curve_file.h>
#include <batten/io/table.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <optional>

namespace batten {
namespace {

const std::string natural_cubic = "natural-cubic";

void refuse_others(const SubdivideArguments& a) {
  const auto refuse = [](bool is_given, const std::string& text) {
    if (is_given) throw UsageError(text);
  };
  refuse(!a.boundary.empty(), "--boundary is for grids; a curve is open, or --closed");
  refuse(a.interpolate + a.smoothing.has_value() + a.tolerance.has_value() > 1,
         "--interpolate, --smoothing and --tolerance exclude each other");
  if (a.scheme.name == natural_cubic) {
    check_fit(a);
    return check_options(a.scheme, {}, {});
  }
  const std::string only = " is for --scheme natural-cubic, found " + a.scheme.name;
  refuse(a.interpolate, "--interpolate" + only);
  refuse(a.smoothing.has_value(), "--smoothing" + only);
  refuse(a.tolerance.has_value(), "--tolerance" + only);
  refuse(!a.tolerance_column.empty(), "--tolerance-column" + only);
  refuse(a.minimum.has_value(), "--minimum" + only);
  refuse(a.maximum.has_value(), "--maximum" + only);
  refuse(a.limit, "--limit" + only);
  refuse(a.show != "result", "--show " + a.show + only);
  refuse(a.parameter != "uniform", "--parameter" + only);
}

CurveSamples polygon_of(const ControlPolygon& polygon, const std::string& name, bool closed) {
  std::vector<double> parameters;
  for (Eigen::Index i = 0; i < polygon.points.rows(); ++i)
    parameters.push_back(polygon.start + static_cast<double>(i) * polygon.spacing);
  return curve_samples(name, polygon.points, parameters, closed);
}

/// What a scheme of masks makes of the points.
CurvePicture subdivided_by_masks(const SubdivideArguments& a, const CurveInput& input) {
  const AnyScheme found = scheme_of(a.scheme);
  const auto* const scheme = std::get_if<Scheme>(&found);
  if (!scheme) throw UsageError("--scheme: " + a.scheme.name + " is a scheme of the plane, the input is a curve");
  require_affine_invariance(*scheme);
  const ControlPolygon control{.points = input.points};
  const ControlPolygon fine = subdivided(
      centred(*scheme), control, {.levels = a.levels, .ends = a.closed ? Ends::Periodic : Ends::Open, .data_level = 0});
  CurvePicture picture{.dimension = input.points.cols()};
  picture.charts = {{{scheme->name(),
                      {polygon_of(control, "control polygon", a.closed),
                       polygon_of(fine, "level " + std::to_string(a.levels), a.closed)}}}};
  return picture;
}

/// Values of a curve under bounds, rounding cut off, at parameters as the rounds of refinement have them.
CurvePicture bounded_picture(const SubdivideArguments& a, const CurveInput& input, const FittedCurve& fitted) {
  const auto& curve = std::get<HermiteCurve>(fitted.curve);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const int parts = 1 << a.levels;
  std::vector<double> parameters, values;
  for (std::size_t cell = 0; cell + 1 < input.knots.size(); ++cell)
    for (int part = 0; part < parts; ++part)
      parameters.push_back(std::lerp(input.knots[cell], input.knots[cell + 1], static_cast<double>(part) / parts));
  if (!a.closed) parameters.push_back(input.knots.back());
  for (const double t : parameters)
    values.push_back(std::clamp(curve.value(t), a.minimum.value_or(-infinity), a.maximum.value_or(infinity)));
  const std::vector<double> places(input.knots.begin(), input.knots.begin() + input.points.rows());
  const Eigen::Map<const Eigen::VectorXd> result(values.data(), static_cast<Eigen::Index>(values.size()));
  return {1,
          {{{"natural cubic within bounds, energy " + std::to_string(fitted.energy),
             {curve_samples("points", input.points, places, a.closed),
              curve_samples("limit", result, parameters, a.closed)}}}}};
}

CurvePicture picture_of(const SubdivideArguments& a, const CurveInput& input, const FittedCurve& fitted) {
  if (is_bounded(a)) return bounded_picture(a, input, fitted);
  return natural_picture(a, input.points, std::get<NaturalCubic>(fitted.curve));
}

std::vector<std::string> notes_of(const SubdivideArguments& a, const FittedCurve& fitted) {
  constexpr double asked_gap = 1e-3;
  const std::string as_values = "under --minimum or --maximum values are written, as with --limit";
  std::vector<std::string> notes;
  if (is_bounded(a) && !a.limit) notes.push_back(as_values);
  if (fitted.account && fitted.account->energy_gap > asked_gap)
    notes.push_back("the energy is known to be the least up to " + number_text(100 * fitted.account->energy_gap, 2) +
                    " %");
  return notes;
}

void write_results(const SubdivideArguments& a, const CurveInput& input, const CurvePicture& picture) {
  const CurveSamples& result = picture.charts.back().back().curves.back();
  if (is_table(a.output)) {
    std::vector<std::string> names = {"parameter"};
    std::vector<std::vector<double>> columns = {result.arrays[0].values};
    const std::vector<const std::vector<double>*> places = {&result.x, &result.y, &result.z};
    for (std::size_t c = 0; c < input.names.size(); ++c) {
      names.push_back(input.names[c]);
      columns.push_back(*places[input.names.size() == 1 ? 1 : c]);
    }
    write_table(a.output, names, columns);
  } else {
    std::vector<CurveSamples> curves;
    for (const auto& row : picture.charts)
      for (const auto& chart : row) curves.insert(curves.end(), chart.curves.begin(), chart.curves.end());
    write_curves(a.output, curves);
  }
  if (!a.picture.empty()) write_curve_picture(a.picture, picture, input.names);
}

}  // namespace

bool is_curve(const SubdivideArguments& arguments) {
  return arguments.scheme.name == natural_cubic || has_header(arguments.input);
}

bool asks_for_curve(const SubdivideArguments& a) {
  return a.closed || a.interpolate || a.smoothing || a.tolerance || a.minimum || a.maximum ||
         !a.tolerance_column.empty() || !a.columns.empty() || !a.report.empty();
}

void subdivide_curve(const SubdivideArguments& a) {
  refuse_others(a);
  check_output_name("-o", a.output, {".vtp", ".csv"});
  check_output_name("--picture", a.picture, {".png"});
  check_output_name("--report", a.report, {".json"});
  Stopwatch total, watch;
  Progress progress("batten subdivide", a.quiet);
  progress.show("read");
  const CurveInput input = read_curve(a);
  if (input.points.cols() > 3)
    throw UsageError("--columns: at most three columns are expected, found " + std::to_string(input.points.cols()));
  const double reading = watch.lap();
  progress.show("subdivide");
  CurvePicture picture;
  std::optional<FittedCurve> fitted;
  std::vector<std::string> notes;
  if (a.scheme.name == natural_cubic) {
    fitted = fitted_curve(a, input, progress);
    notes = notes_of(a, *fitted);
    picture = picture_of(a, input, *fitted);
  } else {
    picture = subdivided_by_masks(a, input);
  }
  const double subdividing = watch.lap();
  progress.show("write " + a.output);
  write_results(a, input, picture);
  const std::size_t points_out = picture.charts.back().back().curves.back().x.size();
  if (!a.report.empty()) {
    const std::vector<PhaseTime> seconds = {
        {"read", reading}, {"subdivide", subdividing}, {"write", watch.lap()}, {"total", total.lap()}};
    write_report({&a, &input, fitted ? &*fitted : nullptr, points_out, notes, seconds});
  }
  progress.erase();
  if (a.quiet) return;
  for (const std::string& text : notes) std::cerr << "batten: note: " << text << '\n';
  std::cout << a.scheme.name << ": " << input.points.rows() << " points -> " << points_out;
  if (fitted) std::cout << ", energy " << number_text(fitted->energy, 6);
  std::cout << "; wrote " << a.output << '\n';
}

}  // namespace batten
