// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/scheme.h>

namespace batten {

// Uniform B-splines n of order m = degree + 1 on the integers: piecewise polynomial of degree m - 1 on [0, m], C^(m-2),
// ∫ n = 1, Σ_i n(x - i) = 1 [Warren & Weimer 2001, ch. 2]. Orders below 1, above 64 and arities other than 2 and 3
// throw InvalidInput.

/// s[x] = arity ((1 + x + ... + x^(arity-1)) / arity)^m; for arity 2, 2^(1-m) (1 + x)^m
/// [Warren & Weimer 2001, eq. 2.7].
Mask<Rational> bspline_mask(int order, int arity = 2);

/// The scheme of that mask; its scaling function n lives on [0, m]. centred() gives the one on [-m/2, m/2].
Scheme bspline_scheme(int order, int arity = 2);

/// p_k from p_{k-1} = p by doubling, p[x] -> 2 p[x^2], and m times averaging neighbours, p -> (1 + x) p / 2
/// [Lane & Riesenfeld 1980]. The same as bspline_mask(m) times p[x^2], bit by bit in rationals.
Mask<Rational> lane_riesenfeld(const Mask<Rational>& p, int order);

/// c(x) = x^(m-1) / (m-1)! for x >= 0, 0 for x < 0: the truncated power, m-fold integral of δ
/// [Warren & Weimer 2001, eq. 2.19].
Rational truncated_power(int order, const Rational& x);

/// d[x] = (1 - x)^m: n(x) = Σ_i d[i] c(x - i).
Mask<Rational> bspline_difference_mask(int order);

/// The derivative of order r of n at x, Σ_i d[i] c^(r)(x - i), exact, and 0 outside [0, m)
/// [Warren & Weimer 2001, th. 2.4]. At the integers the limit from the right, as n = 1 on [0, 1) for m = 1. Throws
/// InvalidInput unless 0 <= r < m.
Rational bspline_value(int order, const Rational& x, int r = 0);
/// The same for a double, derived exactly and rounded once: truncated powers in doubles cancel beyond use at order 15.
double bspline_value(int order, double x, int r = 0);

}  // namespace batten
