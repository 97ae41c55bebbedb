// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/index_box.h>
#include <batten/bases/mask.h>

namespace batten {

struct QuotientOptions {
  double tolerance = 1e-13;  ///< by how much coefficients may change when the nodes of integration are doubled
};

/// The Laurent coefficients of a[x] / b[x] on |x| = 1, c[i] = (1/2π) ∫ a/b e^(-iωi) dω, for all i of a box. Half shifts
/// subtract. As a and b are divided by their common divisor first, common zeros on the circle do not count.
///
/// The trapezoidal rule with so many nodes that the roots of b, of which the nearest to the circle decides, contribute
/// less than rounding [Trefethen & Weideman 2014]. Throws InvalidInput when b is zero, or a root of the reduced b is
/// within 1e-8 of |x| = 1, the message says where.
Mask<double> quotient_coefficients(const Mask<Rational>& a, const Mask<Rational>& b, const IndexBox<1>& box);

/// The Laurent coefficients of a[x,y] / b[x,y] on |x| = |y| = 1. The quotient is bounded there; b may have zeros where
/// a vanishes as well, such as l[x²,y²] / l[x,y] has at (1, 1), where the quotient need not be continuous.
///
/// For one x the trapezoidal rule over y, as above; over x Gauss's rule on panels that end at the zeros of b, between
/// which the inner integrals are analytic. Near zeros of b, a and b are evaluated in 113 bits. The time grows with the
/// box: the nodes next to a zero need about 40 nodes over y for each unit of the inverse distance.
///
/// Throws InvalidInput when b is zero, the quotient is not bounded (saying where b vanishes) or b vanishes along a
/// curve; SolverError when the tolerance is not reached.
Mask2<double> quotient_coefficients(const Mask2<Rational>& a, const Mask2<Rational>& b, const IndexBox<2>& box,
                                    const QuotientOptions& options = {});

}  // namespace batten
