// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <span>

namespace batten {

/// What numbers lead to before they are looked at: whether the knots were found to increase and all numbers of the
/// result to be finite, as they never are where points are not.
struct FoundCoefficients {
  Eigen::MatrixXd coefficients;
  bool are_sound;
};

/// The coefficients of the natural (closed: periodic) cubic spline through points at knots.
///
/// The equations h_(i-1) γ_(i-1) + 2 (h_(i-1) + h_i) γ_i + h_i γ_(i+1) = 6 (slope_i - slope_(i-1)) of the second
/// derivatives are diagonally dominant by 2: what is not known of γ counts half as much one knot further, and less than
/// rounding after 60. Blocks that begin and end 60 knots outside what they fill in need nothing from each other, and a
/// closed curve is an open one that goes round.
FoundCoefficients interpolation_coefficients(std::span<const double> knots, const Eigen::MatrixXd& points, bool closed);

}  // namespace batten
