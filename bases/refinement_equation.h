// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask.h>

#include <map>
#include <optional>

namespace batten {

/// Which limit the values of a function at a point are: of a continuous function, or, where it jumps, from the right
/// (in two dimensions from the right and above), as n = 1 on [0, 1) has n(0) = 1 and n(1) = 0.
enum class Limit { TwoSided, FromRight };

/// Σ_i c[i] x^i in E variables, stored by its terms. E may be 4, as for a product of three functions on the plane.
template <int E>
using Terms = std::map<Index<E>, Rational>;

/// The function f on R^E of integral 1 with f(x) = Σ_j mask[j] f(arity x - j), and one of its derivatives.
template <int E>
struct RefinementEquation {
  Terms<E> mask;  ///< its coefficients sum to arity^E
  int arity = 2;
  /// P of the derivative P(∂) f: all terms are of one degree. f itself for the constant 1.
  Terms<E> derivative = {{Index<E>{}, Rational(1)}};
  Limit limit = Limit::TwoSided;
};

/// v(i) = P(∂) f(i) for all i in Z^E, those that are not zero, as the one solution of v(i) = arity^M Σ_k mask[arity i -
/// k] v(k) on the support, M the degree of P, with the moments Σ_i (-i)^q v(i) = P(∂) x^q for |q| = M
/// [Warren & Weimer 2001, sec. 6.1]. The moments are those of a derivative that exists: where P(∂) f is continuous for
/// all P of degree M, the shifts of f generate the polynomials of degree M.
///
/// Nothing when there is no such solution, or several, or the equation's matrix does not shrink vectors without moments
/// up to degree M (found in doubles). These are necessary for P(∂) f to be continuous where the scheme converges; for
/// the correlation of a function with itself, whose Fourier transform is not negative, the last one decides
/// [Villemoes 1994].
///
/// E = 1, 2, 4. Throws InvalidInput when more than 6000 values are unknown.
template <int E>
std::optional<Terms<E>> integer_values(const RefinementEquation<E>& equation);

/// The terms of a polynomial, a half shift dropped.
template <int D>
Terms<D> terms_of(const LaurentPolynomial<Rational, D>& s);
/// The polynomial of these terms.
template <int D>
LaurentPolynomial<Rational, D> polynomial_of(const Terms<D>& terms, const Index<D>& half = {});
/// a b.
template <int E>
Terms<E> product(const Terms<E>& a, const Terms<E>& b);

}  // namespace batten
