// SPDX-License-Identifier: MIT
#include <batten/bases/derivative_mask.h>
#include <batten/bases/mask_division.h>
#include <batten/domains/errors.h>

#include <string>

namespace batten {
namespace {

/// 1 + x_d + ... + x_d^(arity - 1)
template <int D>
LaurentPolynomial<Rational, D> box_factor(std::size_t d, int arity) {
  Index<D> size;
  size.fill(1);
  size[d] = arity;
  return {Index<D>{}, size, std::vector<Rational>(static_cast<std::size_t>(arity), Rational(1))};
}

}  // namespace

Rational integer_power(const Rational& base, int exponent) {
  Rational result = 1;
  for (int n = 0; n < exponent; ++n) result *= base;
  return result;
}

template <int D>
DerivativeMask<D> derivative_mask(const LaurentPolynomial<Rational, D>& s, int arity, const Index<D>& derivative) {
  if (s.is_zero()) throw InvalidInput("derivative_mask: the mask must not be zero");
  for (int r : derivative)
    if (r < 0)
      throw InvalidInput("derivative_mask: orders of derivatives must not be negative, found " + std::to_string(r));
  DerivativeMask<D> result{s, arity, {}, derivative};
  for (std::size_t d = 0; d < D; ++d) {
    const auto factor = box_factor<D>(d, arity);
    while (result.remaining[d] > 0) {
      auto quotient = quotient_if_exact(result.mask, factor);
      if (!quotient) break;
      result.mask = Rational(arity) * *quotient;
      ++result.differences[d];
      --result.remaining[d];
    }
  }
  return result;
}

template <int D>
LaurentPolynomial<Rational, D> difference_mask(const Index<D>& order) {
  const auto one = LaurentPolynomial<Rational, D>::constant(1);
  auto result = one;
  for (std::size_t d = 0; d < D; ++d) {
    Index<D> unit{};
    unit[d] = 1;
    result *= power(one - LaurentPolynomial<Rational, D>::monomial(unit), order[d]);
  }
  return result;
}

template <int D>
std::optional<LaurentPolynomial<Rational, D>> own_grid_values(const DerivativeMask<D>& mask, Limit limit) {
  if (D == 1 && mask.remaining[0] > 0) return std::nullopt;  // the shifts of a C^r function sum to 1: 1 + x divides
  const auto values =
      integer_values(RefinementEquation<D>{terms_of(mask.mask), mask.arity, {{mask.remaining, Rational(1)}}, limit});
  if (!values) return std::nullopt;
  return polynomial_of<D>(*values, mask.mask.half());
}

template <int D>
std::optional<LaurentPolynomial<Rational, D>> integer_grid_values(const LaurentPolynomial<Rational, D>& s, int arity,
                                                                  const Index<D>& derivative, Limit limit) {
  const bool is_shifted = s.half() != Index<D>{};
  if (is_shifted && arity != 2)
    throw InvalidInput("integer_grid_values: a mask of arity 3 must have whole powers, found half ones");
  const auto mask = derivative_mask(s, arity, derivative);
  auto values = own_grid_values(mask, limit);
  if (!values) return std::nullopt;
  if (is_shifted)  // f(i) = arity^|r| Σ_j s[j] f(arity i - j - half/2)
    values = integer_power(arity, total(mask.remaining)) * coset(mask.mask * *values, Index<D>{}, arity);
  return difference_mask<D>(mask.differences) * *values;
}

template DerivativeMask<1> derivative_mask(const Mask<Rational>&, int, const Index<1>&);
template DerivativeMask<2> derivative_mask(const Mask2<Rational>&, int, const Index<2>&);
template Mask<Rational> difference_mask<1>(const Index<1>&);
template Mask2<Rational> difference_mask<2>(const Index<2>&);
template std::optional<Mask<Rational>> own_grid_values(const DerivativeMask<1>&, Limit);
template std::optional<Mask2<Rational>> own_grid_values(const DerivativeMask<2>&, Limit);
template std::optional<Mask<Rational>> integer_grid_values(const Mask<Rational>&, int, const Index<1>&, Limit);
template std::optional<Mask2<Rational>> integer_grid_values(const Mask2<Rational>&, int, const Index<2>&, Limit);

}  // namespace batten
