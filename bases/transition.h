// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/exact_linear.h>
#include <batten/bases/mask.h>

namespace batten {

// One round of subdivision on a window Ω of indices, once for each digit e in {0 .. arity-1}^D:
// (A_e v)[i] = Σ_j s[i + e - arity j] v[j], so that f_v((x + e)/arity) = f_(A_e v)(x) for the limits f
// [Daubechies & Lagarias 1992; Micchelli & Prautzsch 1989].

/// The digits, x fastest.
template <int D>
std::vector<Index<D>> digits(int arity);

/// Whether A_e v on the window depends on v on the window alone, for every digit.
template <int D>
bool is_invariant(const std::vector<Index<D>>& window, const LaurentPolynomial<Rational, D>& s, int arity);
/// Whether the window holds a translate of {j >= 0, Σ_d j_d <= order}, on which every difference of this order lives.
template <int D>
bool holds_differences(const std::vector<Index<D>>& window, int order);
/// The smallest windows with both properties differ by the place of the translate; one of those with the fewest
/// indices, in ascending order.
template <int D>
std::vector<Index<D>> transition_window(const LaurentPolynomial<Rational, D>& s, int arity, int order);

/// The matrices A_e, e as in digits(), on data modulo polynomials of degree < order. They map polynomials to
/// polynomials when s has sum rules of this order. Coordinates are the values of v less the polynomial that agrees with
/// v at the first unisolvent indices of the window, at the others.
///
/// Their joint spectral radius ρ gives the Hölder exponent: differences of the order after k rounds are at most
/// C (ρ + ε)^k, so that limits are C^α for every α < min(order, -log ρ / log arity)
/// [Daubechies & Lagarias 1992; Rioul 1992; Han & Jia 1998].
template <int D>
std::vector<RationalMatrix> transition_matrices(const LaurentPolynomial<Rational, D>& s, int arity,
                                                const std::vector<Index<D>>& window, int order);

}  // namespace batten
