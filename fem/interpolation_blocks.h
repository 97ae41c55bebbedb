// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <span>

namespace batten {

/// The coefficients of the natural (closed: periodic) cubic spline through points at knots that have been checked.
///
/// The equations h_(i-1) γ_(i-1) + 2 (h_(i-1) + h_i) γ_i + h_i γ_(i+1) = 6 (slope_i - slope_(i-1)) of the second
/// derivatives are diagonally dominant by 2: what is not known of γ counts half as much one knot further, and less than
/// rounding after 60. Blocks that begin and end 60 knots outside what they fill in need nothing from each other, and a
/// closed curve is an open one that goes round.
Eigen::MatrixXd interpolation_coefficients(std::span<const double> knots, const Eigen::MatrixXd& points, bool closed);

}  // namespace batten
