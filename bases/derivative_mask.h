// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/refinement_equation.h>

namespace batten {

/// A derivative of a scaling function n as differences of another one: ∂^r n = ∏_d (1 - x_d)^differences[d] applied to
/// ∂^remaining of the scaling function of `mask`, which has arity^|r - remaining| s / ∏_d (1 + x_d + ... + x_d^(arity -
/// 1))^differences[d] [Warren & Weimer 2001, sec. 6.1].
template <int D>
struct DerivativeMask {
  LaurentPolynomial<Rational, D> mask;
  int arity = 2;
  Index<D> differences{};
  Index<D> remaining{};  ///< where the division fails; zero in one dimension for every derivative that exists
};

/// As many differences as the division allows. Throws InvalidInput when an order is negative or s is zero.
template <int D>
DerivativeMask<D> derivative_mask(const LaurentPolynomial<Rational, D>& s, int arity, const Index<D>& derivative);

/// ∏_d (1 - x_d)^order[d].
template <int D>
LaurentPolynomial<Rational, D> difference_mask(const Index<D>& order);

/// ∂^remaining of the scaling function of the mask, exact, on Z^D + half/2, the grid of its support; nothing where it
/// does not exist.
template <int D>
std::optional<LaurentPolynomial<Rational, D>> own_grid_values(const DerivativeMask<D>& mask, Limit limit);

/// ∂^derivative of the scaling function of s, exact, on Z^D; nothing where it does not exist. Throws InvalidInput for
/// half shifts at arity 3: integers are then on no refinement of the support's grid.
template <int D>
std::optional<LaurentPolynomial<Rational, D>> integer_grid_values(const LaurentPolynomial<Rational, D>& s, int arity,
                                                                  const Index<D>& derivative, Limit limit);

/// The sum of a multi-index.
template <std::size_t N>
int total(const std::array<int, N>& order) {
  int sum = 0;
  for (int r : order) sum += r;
  return sum;
}

/// base^exponent, exponent >= 0.
Rational integer_power(const Rational& base, int exponent);

}  // namespace batten
