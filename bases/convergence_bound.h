// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/scheme.h>

#include <vector>

namespace batten {

/// β α^k / (1 - α), which bounds ‖p_∞ - p_k‖ when ‖p_j - p_(j-1)‖ <= β α^(j-1) for all j [Warren & Weimer 2001,
/// th. 3.1]. Throws InvalidInput unless 0 <= α < 1 and k >= 0.
Rational geometric_tail(const Rational& beta, const Rational& alpha, int k);

/// How far the polygons (in two dimensions piecewise bilinear surfaces) of a convergent scheme are from their limit.
struct ConvergenceBound {
  /// ‖A‖ of S - S_lin = A D, S_lin linear interpolation: one round moves data by at most ‖A‖ ‖D p‖ off the polygon.
  Rational deviation;
  /// ‖T^0‖, ‖T^1‖, ..., the last one below 1, T the difference scheme.
  std::vector<Rational> norms;

  /// The c with ‖p_∞ - p_k‖ <= c ‖D p_0‖, D the first differences:
  /// c = ‖A‖ Σ_(j>=k) ‖T^j‖ <= ‖A‖ (‖T^0‖ + ... + ‖T^(n-1)‖) ‖T^n‖^⌊k/n⌋ / (1 - ‖T^n‖)
  /// [Warren & Weimer 2001, sec. 3.2.2].
  Rational factor(int k) const;
};

/// Throws InvalidInput when the scheme has no rational mask or does not keep constants, SolverError when no power of
/// the difference scheme up to 12 (6 in two dimensions) has a norm below 1.
template <int D>
ConvergenceBound convergence_bound(const SubdivisionScheme<D>& scheme);

}  // namespace batten
