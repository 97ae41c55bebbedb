// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/derivative_mask.h>
#include <batten/bases/scheme.h>

namespace batten {

// Values of the scaling function n of a stationary scheme with rational coefficients, and of its derivatives ∂^r n,
// exact, as polynomials: the coefficient of x^i is the value at i, or at i / arity^level. They solve the refinement
// equation [Warren & Weimer 2001, sec. 6.1]. Where it has no solution, or several, the derivative does not exist; a
// solution alone does not prove that it does, nor that the scheme converges.

/// ∂^r n on Z^D. Throws InvalidInput when the mask is not affine invariant, has half shifts at arity 3, or the
/// derivative does not exist ("four-point is at most C^1: no second derivative").
template <int D>
LaurentPolynomial<Rational, D> values_at_integers(const SubdivisionScheme<D>& scheme, const Index<D>& derivative = {},
                                                  Limit limit = Limit::TwoSided);

/// ∂^r n on Z^D / arity^level. Throws as above, and when level < 0.
template <int D>
LaurentPolynomial<Rational, D> values_at_level(const SubdivisionScheme<D>& scheme, int level,
                                               const Index<D>& derivative = {}, Limit limit = Limit::TwoSided);

/// ∂^r Σ_i p[i] n(x - i) on Z^D / arity^level, for control points p on Z^D: differences of p, `level` rounds of
/// subdivision, then the limit stencil. Over doubles a value errs by at most (level + 2) (m + 2) ε times the sum of the
/// absolute terms it is made of, m the number of coefficients of the mask. Throws as above, and when p has half powers.
template <Coefficient T, int D>
LaurentPolynomial<T, D> limit_values(const SubdivisionScheme<D>& scheme, const LaurentPolynomial<T, D>& p, int level,
                                     const Index<D>& derivative = {});

/// Throws the InvalidInput of a derivative that does not exist.
template <int D>
[[noreturn]] void throw_missing_derivative(const char* function, const SubdivisionScheme<D>& scheme,
                                           const Index<D>& derivative);

}  // namespace batten
