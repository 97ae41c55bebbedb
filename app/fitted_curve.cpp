// SPDX-License-Identifier: MIT
#include <batten/app/fitted_curve.h>
#include <batten/app/usage_error.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/curve_fit.h>

#include <cmath>

namespace batten {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double length_of(const CurveInput& input) { return input.knots.back() - input.knots.front(); }

/// Of smoothing_curve: L is stated for parameters from 0 to 1 and the mean of the squares.
double lambda_of(const SubdivideArguments& a, const CurveInput& input) {
  return *a.smoothing * std::pow(length_of(input), 3) * static_cast<double>(input.points.rows());
}

std::string place_of(const SubdivideArguments& a, const CurveInput& input, std::size_t i) {
  return a.input + ": line " + std::to_string(input.lines[i]) + ": ";
}

std::vector<double> tolerances_of(const SubdivideArguments& a, const CurveInput& input) {
  std::vector<double> result;
  for (std::size_t i = 0; i < input.lines.size() && a.tolerance; ++i) {
    const double factor = input.tolerances.empty() ? 1 : input.tolerances[i];
    if (!(factor > 0))
      throw InvalidInput(place_of(a, input, i) + "a tolerance must be positive, found " + number_text(factor, 6));
    result.push_back(factor * *a.tolerance);
  }
  return result;
}

void check_bounds(const SubdivideArguments& a, const CurveInput& input, const std::vector<double>& tolerances) {
  for (std::size_t i = 0; i < input.lines.size() && a.smoothing.value_or(0) == 0; ++i) {
    const double point = input.points(static_cast<Eigen::Index>(i), 0), tolerance = a.tolerance ? tolerances[i] : 0;
    const std::string within = a.tolerance ? " and all within " + number_text(tolerance, 6) + " of it" : "";
    const std::string value = place_of(a, input, i) + "the value " + number_text(point, 6) + within;
    if (a.maximum && point - tolerance > *a.maximum)
      throw InvalidInput(value + " is above --maximum " + number_text(*a.maximum, 6));
    if (a.minimum && point + tolerance < *a.minimum)
      throw InvalidInput(value + " is below --minimum " + number_text(*a.minimum, 6));
  }
}

FittedCurve with_bounds(const SubdivideArguments& a, const CurveInput& input) {
  const auto tolerances = tolerances_of(a, input);
  check_bounds(a, input, tolerances);
  CurveBounds bounds{a.minimum.value_or(-infinity), a.maximum.value_or(infinity), tolerances, {}, a.closed};
  if (a.smoothing.value_or(0) > 0) bounds.lambda = lambda_of(a, input);
  BoundedCurve found = bounded_curve(input.knots, input.points.col(0), bounds);
  Eigen::MatrixXd values(input.points.rows(), 1);
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    values(i, 0) = found.curve.value(input.knots[static_cast<std::size_t>(i)]);
  const double energy = found.account.energy;
  return {std::move(found.curve), found.account, std::move(values), energy / std::pow(length_of(input), 3), energy};
}

FittedCurve natural(const CurveInput& input, NaturalCubic curve, std::optional<CurveAccount> account = {}) {
  Eigen::MatrixXd values = curve.values();
  const double energy = curve.energy();
  return {std::move(curve), account, std::move(values), energy, energy * std::pow(length_of(input), 3)};
}

}  // namespace

bool is_bounded(const SubdivideArguments& a) { return a.minimum || a.maximum; }

void check_fit(const SubdivideArguments& a) {
  const auto refuse = [](bool is_given, const std::string& text) {
    if (is_given) throw UsageError(text);
  };
  const bool is_fit = a.interpolate || a.smoothing || a.tolerance;
  refuse(!a.tolerance_column.empty() && !a.tolerance,
         "--tolerance-column needs --tolerance E: tolerances are its values times E");
  refuse(is_bounded(a) && !is_fit, "--minimum and --maximum need --interpolate, --smoothing or --tolerance");
  refuse(is_bounded(a) && a.show != "result", "--show " + a.show + " is for curves without --minimum and --maximum");
  refuse(a.minimum && a.maximum && *a.minimum >= *a.maximum, "--minimum must be below --maximum, found " +
                                                                 number_text(a.minimum.value_or(0), 6) + " and " +
                                                                 number_text(a.maximum.value_or(0), 6));
}

FittedCurve fitted_curve(const SubdivideArguments& a, const CurveInput& input, Progress& progress) {
  if (is_bounded(a) && input.points.cols() != 1)
    throw UsageError("--minimum and --maximum are for one column of values, found " +
                     std::to_string(input.points.cols()) + ": choose one with --columns");
  if (is_bounded(a)) return with_bounds(a, input);
  if (a.interpolate) return natural(input, interpolating_curve(input.knots, input.points, a.closed));
  if (a.smoothing) return natural(input, smoothing_curve(input.knots, input.points, {}, lambda_of(a, input), a.closed));
  if (!a.tolerance) return natural(input, {input.knots, input.points, a.closed});
  CurveWithinOptions options;
  options.closed = a.closed;
  options.progress = [&](double done) { progress.show("subdivide", done); };
  CurveWithin within = least_curve_within(input.knots, input.points, tolerances_of(a, input), options);
  return natural(input, std::move(within.curve), within.account);
}

}  // namespace batten
