// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/hoelder.h>
#include <batten/bases/smoothness.h>

#include <string>

namespace batten {

// Certificates are taken from anyone: each check starts from the mask and the claim alone and runs in exact arithmetic.
// It shares the definitions with those who look for certificates (masks, differences, norms, local matrices), no
// search. What comes back says what is wrong first; it is empty when the certificate proves the claim.

/// That the differences shrink as said.
template <int D>
std::string fault_of(const Contraction<D>& proof, const LaurentPolynomial<Rational, D>& s, int arity = 2);

/// That limits are not C^m.
template <int D>
std::string fault_of(const Roughness<D>& obstacle, int m, const LaurentPolynomial<Rational, D>& s, int arity = 2);
/// That limits have no greater Hölder exponent than exponent_of(roughness), given that the scheme converges.
template <int D>
std::string fault_of(const Roughness<D>& roughness, const LaurentPolynomial<Rational, D>& s, int arity = 2);

/// That a coset sums to what is said, and not to 1.
template <int D>
std::string fault_of(const CosetDefect<D>& defect, const LaurentPolynomial<Rational, D>& s, int arity = 2);

/// That the mask is the box spline's and converges.
template <int D>
std::string fault_of(const BoxFactors<D>& box, const LaurentPolynomial<Rational, D>& s, int arity = 2);

/// That the transition matrices keep the polytope.
template <int D>
std::string fault_of(const InvariantPolytope<D>& polytope, const LaurentPolynomial<Rational, D>& s, int arity = 2);

/// All of a verdict: C^continuity, and not C^(continuity + 1) when it says so.
template <int D>
std::string fault_of(const Smoothness<D>& verdict, const LaurentPolynomial<Rational, D>& s, int arity = 2);

/// Both bounds, and that the scheme converges: the polytope's radius is below 1.
template <int D>
std::string fault_of(const HoelderBounds<D>& bounds, const LaurentPolynomial<Rational, D>& s, int arity = 2);

}  // namespace batten
