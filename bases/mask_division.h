// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask.h>

#include <optional>

namespace batten {

/// a / b among Laurent polynomials, nothing when b does not divide a. Half shifts subtract.
///
/// Over doubles the remainder counts as zero when each of its coefficients is at most 64 ε n (max|a| + max|b|
/// max|a/b|), n the number of coefficients of the quotient. Throws InvalidInput when b is zero.
template <Coefficient T, int D>
std::optional<LaurentPolynomial<T, D>> quotient_if_exact(const LaurentPolynomial<T, D>& a,
                                                         const LaurentPolynomial<T, D>& b);

/// a / b; throws InvalidInput that names the remainder when b does not divide a.
template <Coefficient T, int D>
LaurentPolynomial<T, D> exact_quotient(const LaurentPolynomial<T, D>& a, const LaurentPolynomial<T, D>& b);

template <Coefficient T, int D>
bool divides(const LaurentPolynomial<T, D>& b, const LaurentPolynomial<T, D>& a) {
  return quotient_if_exact(a, b).has_value();
}

/// How often b divides a: the largest n for which b^n does. Throws InvalidInput when a is zero or b has a single term.
template <Coefficient T, int D>
int multiplicity(const LaurentPolynomial<T, D>& b, const LaurentPolynomial<T, D>& a);

}  // namespace batten
