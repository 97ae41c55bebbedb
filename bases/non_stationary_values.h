// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/scheme.h>

namespace batten {

/// Values and a bound on the error of each.
template <int D>
struct BoundedValues {
  LaurentPolynomial<double, D> values;
  double error = 0;
};

/// n on Z^D / arity^level, n the scaling function that all levels of a scheme lead to: coefficient i is n(i /
/// arity^level). For schemes that are not stationary, or not rational.
///
/// The masks are followed to the level M on which they stop to change in doubles; there the values on Z^D are those of
/// the stationary scheme with mask s_M, and each mask s_k, k = M .. 1, is put in front of them.
///
/// The error counts rounding, and what the masks after M may add. It assumes what no finite number of masks can prove:
/// that the masks after level M go on to change by less and less, at the geometric rate seen on the levels before, and
/// that products of their matrices stay within the bound seen up to M. It presumes that the limit exists.
///
/// Throws InvalidInput when the level is negative, the masks do not settle within 400 levels or not at a geometric
/// rate, the last mask does not determine values (its scheme is not continuous), or half shifts meet arity 3.
template <int D>
BoundedValues<D> bounded_values_at_level(const SubdivisionScheme<D>& scheme, int level);

}  // namespace batten
