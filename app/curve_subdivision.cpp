// SPDX-License-Identifier: MIT
#include <batten/app/curve_input.h>
#include <batten/app/curve_pictures.h>
#include <batten/app/curve_subdivision.h>
#include <batten/app/output_names.h>
#include <batten/app/progress.h>
#include <batten/app/scheme_catalogue.h>
#include <batten/app/usage_error.h>
#include <batten/bases/subdivide.h>
#include <batten/domains/number_text.h>
#include <batten/fem/curve_fit.h>
#include <batten/io/curve_file.h>
#include <batten/io/table.h>

#include <iostream>

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
  if (a.scheme.name == natural_cubic) return check_options(a.scheme, {}, {});
  const std::string only = " is for --scheme natural-cubic, found " + a.scheme.name;
  refuse(a.interpolate, "--interpolate" + only);
  refuse(a.smoothing.has_value(), "--smoothing" + only);
  refuse(a.tolerance.has_value(), "--tolerance" + only);
  refuse(a.limit, "--limit" + only);
  refuse(a.show != "result", "--show " + a.show + only);
  refuse(a.parameter != "uniform", "--parameter" + only);
}

/// The natural cubic that is asked for: with these points as coefficients, or through, near or within bounds of them.
NaturalCubic natural_curve(const SubdivideArguments& a, const CurveInput& input) {
  if (a.interpolate) return interpolating_curve(input.knots, input.points, a.closed);
  if (a.tolerance) {
    const std::vector<double> tolerances(static_cast<std::size_t>(input.points.rows()), *a.tolerance);
    return curve_within(input.knots, input.points, tolerances, a.closed);
  }
  if (!a.smoothing) return {input.knots, input.points, a.closed};
  // lambda is stated for parameters from 0 to 1 and the mean of the squares
  const double length = input.knots.back() - input.knots.front();
  const double lambda = *a.smoothing * length * length * length * static_cast<double>(input.points.rows());
  return smoothing_curve(input.knots, input.points, {}, lambda, a.closed);
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

void subdivide_curve(const SubdivideArguments& a) {
  refuse_others(a);
  check_output_name("-o", a.output, {".vtp", ".csv"});
  check_output_name("--picture", a.picture, {".png"});
  Progress progress("batten subdivide", a.quiet);
  progress.show("read");
  const CurveInput input = read_curve(a);
  if (input.points.cols() > 3)
    throw UsageError("--columns: at most three columns are expected, found " + std::to_string(input.points.cols()));
  progress.show("subdivide");
  double energy = -1;
  CurvePicture picture;
  if (a.scheme.name == natural_cubic) {
    const NaturalCubic curve = natural_curve(a, input);
    energy = curve.energy();
    picture = natural_picture(a, input.points, curve);
  } else {
    picture = subdivided_by_masks(a, input);
  }
  progress.show("write " + a.output);
  write_results(a, input, picture);
  progress.erase();
  if (a.quiet) return;
  std::cout << a.scheme.name << ": " << input.points.rows() << " points -> "
            << picture.charts.back().back().curves.back().x.size();
  if (energy >= 0) std::cout << ", energy " << number_text(energy, 6);
  std::cout << "; wrote " << a.output << '\n';
}

}  // namespace batten
