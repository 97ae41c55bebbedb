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
/// derivatives are diagonally dominant by 2: what is not known of γ counts at most 1 / (2 + 3 r / 2) times as much one
/// knot further, where cells get r times as wide, and less than rounding after 60 knots: 2^-60 of γ for any widths, and
/// where cells grow by 10^10 among the 60, so that bends of narrow ones are 10^20 times as large, 10^-37 of γ. Blocks
/// that begin and end 60 knots outside what they fill in need nothing from each other, and a closed curve is an open
/// one that goes round.
FoundCoefficients interpolation_coefficients(std::span<const double> knots, const Eigen::MatrixXd& points, bool closed);

}  // namespace batten
