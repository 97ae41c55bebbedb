// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/natural_cubic.h>

#include <span>
#include <vector>

namespace batten {

// Curves of least energy through or near points, one row for each; the parameter of point i is knot i. Work is linear
// in the number of points. Closed curves have one knot more than points. All functions throw InvalidInput as
// NaturalCubic does.

/// The natural (closed: periodic) cubic spline through the points: p_0 = N^-1 b [Warren & Weimer 2001, sec. 6.3.1].
NaturalCubic interpolating_curve(std::vector<double> knots, const Eigen::MatrixXd& points, bool closed = false);

/// The curve that minimises Σ_i w_i |p(t_i) - b_i|² + λ ∫ |p''|² dt [Reinsch 1967]; λ = 0 interpolates. Empty weights
/// are all 1. As accurate for every λ, up to the regression line. Throws InvalidInput when a weight is not positive or
/// λ negative.
NaturalCubic smoothing_curve(std::vector<double> knots, const Eigen::MatrixXd& points, std::span<const double> weights,
                             double lambda, bool closed = false);

/// The curve of least_curve_within alone.
NaturalCubic curve_within(std::vector<double> knots, const Eigen::MatrixXd& points, std::span<const double> tolerances,
                          bool closed = false);

/// Parameters for points: 0 and sums of distances to the power `exponent`: 0 equal steps, 1/2 centripetal, 1 the
/// lengths of chords. One more for the closing chord. Throws InvalidInput that names the first two consecutive points
/// that are the same, unless the exponent is 0.
std::vector<double> curve_parameters(const Eigen::MatrixXd& points, double exponent, bool closed = false);

}  // namespace batten
