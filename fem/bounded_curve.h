// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/curve_within.h>
#include <batten/fem/hermite_curve.h>

#include <limits>
#include <optional>

namespace batten {

/// What a curve of numbers has to keep: bounds everywhere between its ends, and its data. Without tolerances and λ it
/// passes through them.
struct CurveBounds {
  double minimum = -std::numeric_limits<double>::infinity(), maximum = std::numeric_limits<double>::infinity();
  std::span<const double> tolerances;  ///< |p(t_i) - b_i| <= tolerances_i
  std::optional<double> lambda;        ///< positive: of smoothing_curve, instead
  bool closed = false;
};

struct BoundedCurve {
  HermiteCurve curve;
  CurveAccount account;
};

/// The curve of least ∫ |p''|², or Σ_i |p(t_i) - b_i|² + λ ∫ |p''|², among those with minimum <= p(t) <= maximum for
/// all t, up to 0.1 %. It is cubic between the data and the places where a bound is met, which are found by adding
/// those where the last curve is outside; where it meets a bound at data it may have a jump of p''. Bounds are kept to
/// 1e-12 of the range of the data, which `value` is not cut to. The account's energy gap is that of what is minimised,
/// with 1e-8 of the squared range (for λ at each point) as the least, and `active` counts places as well.
///
/// Throws InvalidInput as least_curve_within and smoothing_curve do, when the minimum is not below the maximum, and for
/// data to be kept that the bounds do not let be; SolverError when bounds are not kept after 30 rounds.
BoundedCurve bounded_curve(const std::vector<double>& knots, const Eigen::VectorXd& points, const CurveBounds& bounds);

}  // namespace batten
