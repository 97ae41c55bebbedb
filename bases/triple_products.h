// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/inner_products.h>
#include <batten/bases/refinement_equation.h>

namespace batten {

/// ∫ ∂^a n(x) ∂^b m(x - i) ∂^c l(x - j) dx for all i, j in Z^D, exact.
///
/// As a function of (i, j) in R^2D they satisfy the refinement equation with the mask arity^-D Σ_pqw s[p] t[q] u[w]
/// x^(p - q) y^(p - w), s, t, u the masks of n, m, l; the derivatives are -∂_i on m, -∂_j on l and ∂_i + ∂_j on n.
/// Tensor products are taken apart.
template <int D>
class TripleProducts {
public:
  /// Throws InvalidInput when a scheme is not stationary, rational and affine invariant, the arities or the half shifts
  /// differ, an integral does not exist, or the equation has more unknowns than integer_values takes: on the plane that
  /// is so for three masks of seven by seven coefficients, unless they are tensor products.
  TripleProducts(const Factor<D>& n, const Factor<D>& m, const Factor<D>& l);

  Rational operator()(const Index<D>& i, const Index<D>& j) const;
  /// Those that are not zero, by (i, j).
  const Terms<2 * D>& terms() const { return terms_; }

private:
  Terms<2 * D> terms_;
};

}  // namespace batten
