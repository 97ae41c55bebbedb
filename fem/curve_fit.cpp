// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/domains/errors.h>
#include <batten/fem/curve_checks.h>
#include <batten/fem/curve_fit.h>
#include <batten/fem/curve_within.h>
#include <batten/fem/interpolation_blocks.h>
#include <batten/fem/smoothing_blocks.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace batten {
namespace {

/// The largest one; 1 without weights.
double largest_weight(std::span<const double> weights, Eigen::Index points) {
  if (weights.empty()) return 1;
  if (static_cast<Eigen::Index>(weights.size()) != points)
    throw InvalidInput("smoothing_curve: one weight for each of " + std::to_string(points) +
                       " points is needed, found " + std::to_string(weights.size()));
  double largest = 0;
  bool are_positive = true;
  const RowBlocks blocks(static_cast<int>(points), 1);
#pragma omp parallel for schedule(static) reduction(max : largest) reduction(&& : are_positive) if (blocks.count() > 1)
  for (int block = 0; block < blocks.count(); ++block) {
    const int begin = blocks.begin(block);
    const double found = largest_of_positive(weights.data() + begin, blocks.end(block) - begin);
    largest = std::max(largest, found);
    are_positive = found > 0 && are_positive;
  }
  if (are_positive) return largest;
  const auto is_bad = [](double w) { return !(w > 0) || !std::isfinite(w); };
  const auto bad = std::find_if(weights.begin(), weights.end(), is_bad);
  throw InvalidInput("smoothing_curve: weights must be positive, found " + std::to_string(*bad) + " at place " +
                     std::to_string(bad - weights.begin()));
}

/// Refuses what the numbers were found to be: input first, then a result that overflows.
NaturalCubic checked_curve(std::vector<double> knots, const Eigen::MatrixXd& points, bool closed,
                           FoundCoefficients found) {
  if (found.are_sound) return NaturalCubic::of_checked(std::move(knots), std::move(found.coefficients), closed);
  NaturalCubic::require(knots, points, closed);
  return {std::move(knots), std::move(found.coefficients), closed};
}

}  // namespace

NaturalCubic interpolating_curve(std::vector<double> knots, const Eigen::MatrixXd& points, bool closed) {
  NaturalCubic::require_sizes(knots, points, closed);
  FoundCoefficients found = interpolation_coefficients(knots, points, closed);
  return checked_curve(std::move(knots), points, closed, std::move(found));
}

NaturalCubic smoothing_curve(std::vector<double> knots, const Eigen::MatrixXd& points, std::span<const double> weights,
                             double lambda, bool closed) {
  if (!(lambda >= 0) || !std::isfinite(lambda))
    throw InvalidInput("smoothing_curve: lambda must be finite and not negative, found " + std::to_string(lambda));
  NaturalCubic::require_sizes(knots, points, closed);
  const double largest = largest_weight(weights, points.rows());
  if (lambda == 0) return interpolating_curve(std::move(knots), points, closed);
  const double per_cell = static_cast<double>(knots.size() - 1) / (knots.back() - knots.front());
  const double per_weight = 1 / std::max(largest, 1e-300);
  // Beyond the limit λ changes the straight line of the limit by less than rounding.
  const double limit = 1e18 * std::pow(static_cast<double>(points.rows()), 4);
  const double stiffness = std::clamp(lambda * per_weight * std::pow(per_cell, 3), 1e-100, limit);
  const SmoothingProblem problem{knots, points, weights, per_cell / std::cbrt(stiffness), per_weight, closed};
  FoundCoefficients found = smoothing_coefficients(problem);
  return checked_curve(std::move(knots), points, closed, std::move(found));
}

NaturalCubic curve_within(std::vector<double> knots, const Eigen::MatrixXd& points, std::span<const double> tolerances,
                          bool closed) {
  CurveWithinOptions options;
  options.closed = closed;
  return least_curve_within(std::move(knots), points, tolerances, options).curve;
}

std::vector<double> curve_parameters(const Eigen::MatrixXd& points, double exponent, bool closed) {
  std::vector<double> parameters = {0};
  const Eigen::Index n = points.rows();
  for (Eigen::Index i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const double length = (points.row((i + 1) % n) - points.row(i)).norm();
    const double step = exponent == 0 ? 1 : std::pow(length, exponent);
    if (!(step > 0))
      throw InvalidInput("curve_parameters: consecutive points must differ, found points " + std::to_string(i) +
                         " and " + std::to_string((i + 1) % n) + " at the same place");
    parameters.push_back(parameters.back() + step);
  }
  return parameters;
}

}  // namespace batten
