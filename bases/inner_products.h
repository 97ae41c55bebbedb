// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/scheme.h>

#include <span>

namespace batten {

/// ∂^derivative n of a scheme's scaling function n, as a factor of an integrand.
template <int D>
struct Factor {
  SubdivisionScheme<D> scheme;
  Index<D> derivative{};
};

// All schemes are stationary with rational coefficients, affine invariant and, in one integral, of the same arity. What
// does not fit throws InvalidInput.

/// ∫ ∂^r n(x) ∂^q m(x - i) dx for all i, exact: coefficient i. It is (-1)^|q| ∂^(r+q) φ(i), φ the scaling function of
/// s[x] t[1/x] / arity^D for the masks s, t of n, m [Warren & Weimer 2001, sec. 6.1].
///
/// Where n or m is not so smooth the integral is that of ∂^(r+q) φ where φ is: ∫ n'' m means -∫ n' m'. Throws
/// InvalidInput when that derivative of φ does not exist.
template <int D>
LaurentPolynomial<Rational, D> inner_products(const Factor<D>& n, const Factor<D>& m);

/// ∫ ∂^r n(x) dx over the cell i + [0, 1]^D, for all i, exact: coefficient i. Throws as above.
template <int D>
LaurentPolynomial<Rational, D> cell_integrals(const Factor<D>& n);

/// The scheme of n = 1 on [0, 1)^D, 0 elsewhere.
template <int D>
SubdivisionScheme<D> unit_cell_scheme(int arity);

/// ∫ x^power n(x) dx, exact, by M_k = arity^(-D-|k|) Σ_j s[j] ∫ (x + j)^k n(x) dx. Throws InvalidInput when a power is
/// negative.
template <int D>
Rational moment(const SubdivisionScheme<D>& scheme, const Index<D>& power);

/// e[i] = ∫ n(x) n'(x - i) dx, exact: the closed curve Σ_j (x_j, y_j) n(. - j) encloses the area Σ_jk x_j e[k - j] y_k
/// [Warren & Weimer 2001, sec. 6.1]. Antisymmetric.
Mask<Rational> area_form(const Scheme& scheme);

/// The area that the limit of a closed control polygon encloses, positive when it is run through anticlockwise; parts
/// that are run around several times count as often. Exact over rationals. Throws InvalidInput unless there are as many
/// x as y, at least one.
template <Coefficient T>
T enclosed_area(const Scheme& scheme, std::span<const T> x, std::span<const T> y);

}  // namespace batten
