// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/exact_linear.h>
#include <batten/bases/mask.h>

#include <optional>

namespace batten {

/// A point of contraction: the digits of n rounds take x to (x + shift) / arity^n, which keeps
/// x* = shift / (arity^n - 1). Shift 0 is the grid point 0 itself.
template <int D>
struct FixedPoint {
  int steps = 1;     ///< n
  Index<D> shift{};  ///< from 0 to arity^n - 2 each
};

/// What is identified at a fixed point: nothing, or data whose limits agree on the points arity^-k (x - x*), x a point
/// of arity^-2 Z^D near x*. The limits are then assumed to be continuous.
enum class LocalData { Coefficients, Limits };

/// det(λ - A), A the n rounds of subdivision of the data v that a limit depends on near x*,
/// (A v)[i] = Σ_j s_n[i + shift - arity^n j] v[j], on the quotient space of `data`.
///
/// Throws InvalidInput when limits are asked for and grid_values() does not have them.
template <int D>
std::vector<Rational> local_characteristic_polynomial(const LaurentPolynomial<Rational, D>& s, int arity,
                                                      const FixedPoint<D>& point, LocalData data);

/// Whether det(λ - A) has an eigenvalue |λ| >= radius, radius <= 1, besides those that smooth limits have: arity^(-n j)
/// >= radius, as often as there are monomials of degree j, j = 0, 1, ...
///
/// If so, some limit is not C^α for α = -log(radius) / (n log arity): not C^m when radius = arity^(-n m), not Hölder
/// continuous of a greater order otherwise. For let v be an eigenvector, f its limit: f((x - x*) arity^-n + x*) =
/// λ f(x) near x*. A Taylor polynomial q of f of degree m has the same scaling up to o(|x|^m), so it is zero or
/// homogeneous with λ = arity^(-n j); f - q is o(|x|^m) and grows by λ >= arity^(-n m) from scale to scale, so it is
/// zero. Generalised eigenvectors likewise have no Jordan block: their limits are polynomials, homogeneous of degree j.
/// [Daubechies & Lagarias 1992; Warren & Weimer 2001, ch. 8, for the idea]
template <int D>
bool has_rough_eigenvalue(std::vector<Rational> characteristic, const Rational& radius, int steps, int arity);

/// The values of a continuous scaling function at grid points, Σ h = 1: the only solution of
/// h[i] = Σ_j s[arity i - j] h[j] on the grid points inside the support, nothing where there is none or more.
template <int D>
std::optional<LaurentPolynomial<Rational, D>> grid_values(const LaurentPolynomial<Rational, D>& s, int arity = 2);

}  // namespace batten
