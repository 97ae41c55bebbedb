// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/natural_cubic.h>

#include <functional>
#include <span>
#include <vector>

namespace batten {

/// What is known of the least energy of a curve under constraints.
struct CurveAccount {
  double energy = 0;  ///< ∫ |p''|² with the parameter from 0 to 1
  /// (energy - bound) / max(energy, 1e-8 range²); the bound is that of forces that are in balance, and the range the
  /// largest of a component of the points.
  double energy_gap = 0;
  double largest_violation = 0;  ///< beyond what is allowed, over that
  /// Points that are held: their force over the largest one is more than their way to the limit over its width.
  int active = 0;
  int factorisations = 0;
};

struct CurveWithinOptions {
  bool closed = false;
  double gap = 1e-3;  ///< asked of CurveAccount::energy_gap
  /// Called with the part of the way that is done, from 0 to 1.
  std::function<void(double done)> progress;
};

struct CurveWithin {
  NaturalCubic curve;
  CurveAccount account;
};

/// The curve of least ∫ |p''|² among those with |p(t_i) - b_i| <= tolerances_i at knot i, by an interior-point method
/// whose work is linear in the number of points; a straight line (closed: a point) wherever one is near enough. Points
/// are rows, of dimension 1 to 3; closed curves have one knot more than points.
///
/// Throws InvalidInput as NaturalCubic does, for other dimensions, and when a tolerance is not positive. Where
/// rounding is as large as the tolerances the curve passes through the points; where they are less than 1e-5 of
/// themselves short of a straight line the gap may stay open.
CurveWithin least_curve_within(std::vector<double> knots, const Eigen::MatrixXd& points,
                               std::span<const double> tolerances, const CurveWithinOptions& options = {});

}  // namespace batten
