// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask.h>
#include <batten/bases/mask_values.h>

namespace batten {

/// The order of the sum rules of s: the largest k for which the sums Σ_i p(arity i + r) s[arity i + r] do not depend on
/// the coset r for any polynomial p of degree < k. Equivalently all derivatives of order < k of s vanish at the
/// (root of unity)^arity != 1, in two dimensions at (-1,1), (1,-1), (-1,-1) [Warren & Weimer 2001, eq. 3.15]; in one
/// dimension (1 + ... + x^(arity-1))^k divides s [ibid., th. 3.7].
///
/// Zero when constants are not reproduced. Throws InvalidInput when s is zero or the arity is not 2 or 3.
template <int D>
int sum_rule_order(const LaurentPolynomial<Rational, D>& s, int arity = 2);

/// How far a scheme keeps polynomials.
template <int D>
struct PolynomialDegrees {
  /// The largest m for which limits contain, data of polynomials of degree <= m lead to polynomials of the same degree:
  /// sum rules of order m + 1; -1 for none.
  int generated;
  /// The largest m <= generated for which data p(i) has the limit p(x + shift) for all p of degree <= m.
  int reproduced;
  /// The parameter shift τ/(arity - 1), τ_d = ∂_d s(1) / arity^D: 0 for schemes centred on an old point. With it linear
  /// functions are always reproduced when they are generated: data belong to i + shift
  /// [Conti & Hormann 2011].
  Coordinates<Rational, D> shift;
};

/// Throws as sum_rule_order does. Half shifts of s count.
template <int D>
PolynomialDegrees<D> polynomial_degrees(const LaurentPolynomial<Rational, D>& s, int arity = 2);

}  // namespace batten
