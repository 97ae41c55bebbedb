// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask.h>
#include <batten/bases/mask_matrix.h>

#include <vector>

namespace batten {

// Differences of the data of one level from those of the level before: d[x] s[x] = t[x] d[x^arity], d[x] = 1 - x
// [Warren & Weimer 2001, th. 3.4]. Half shifts of masks do not count: smoothness does not see them.

/// The scheme of differences of the given order >= 1, divided so that it keeps derivatives of order - 1:
/// t = arity^(order-1) s / (1 + ... + x^(arity-1))^order [Warren & Weimer 2001, sec. 3.2.3]. It is S's own s / (1 + x)
/// for order 1. Throws InvalidInput when the division leaves a remainder.
Mask<Rational> difference_scheme(const Mask<Rational>& s, int order, int arity = 2);

/// The differences of order q: {(1-x)^q} in one dimension, {(1-x)^q, (1-x)^(q-1) (1-y), ..., (1-y)^q} in two.
template <int D>
std::vector<LaurentPolynomial<Rational, D>> difference_operators(int order);

/// Whether T gives the differences of order q of the data after `steps` rounds of s, scaled to derivatives of order
/// q - 1: arity^((q-1) steps) δ[x] s_n[x] = T[x] δ[x^(arity^steps)], δ the column of difference operators, s_n the
/// iterated mask. In matrices D S = T D [Warren & Weimer 2001, eq. 3.3 and th. 3.10].
template <int D>
bool is_difference_scheme(const MaskMatrix<Rational, D>& t, const LaurentPolynomial<Rational, D>& s, int order,
                          int steps = 1, int arity = 2);

/// ‖T^n‖, the largest absolute row sum of n rounds: T_n[x] = ∏_i T[x^(arity^i)], i = 0 .. n - 1; the largest over rows
/// and residues r mod arity^n of Σ_columns Σ_j |T_n[arity^n j + r]| [Warren & Weimer 2001, sec. 3.2.2, eq. 3.14].
/// n >= 0. T has integer exponents.
template <int D>
Rational iterated_norm(const MaskMatrix<Rational, D>& t, int n, int arity = 2);
/// ‖T^n‖ of one mask.
Rational iterated_norm(const Mask<Rational>& t, int n, int arity = 2);

/// ‖T^n‖ for n = 1, 2, ... up to `most`, the last one the first below 1 where there is one.
template <int D>
std::vector<Rational> norms_until_contraction(const MaskMatrix<Rational, D>& t, int most, int arity = 2);

/// The mask without its half shift.
template <int D>
LaurentPolynomial<Rational, D> without_half_shift(const LaurentPolynomial<Rational, D>& s);

}  // namespace batten
