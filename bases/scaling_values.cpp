// SPDX-License-Identifier: MIT
#include <batten/bases/scaling_values.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <string>

namespace batten {
namespace {

template <Coefficient T, int D>
LaurentPolynomial<T, D> converted(const LaurentPolynomial<Rational, D>& s) {
  if constexpr (std::same_as<T, Rational>)
    return s;
  else
    return to_double(s);
}

std::string order_text(const Index<1>& order) {
  constexpr std::array names = {"no values", "no first derivative", "no second derivative", "no third derivative"};
  return order[0] < 4 ? names[static_cast<std::size_t>(order[0])]
                      : "no derivative of order " + std::to_string(order[0]);
}

std::string order_text(const Index<2>& order) {
  if (order == Index<2>{}) return "no values";
  return "no derivative of order (" + std::to_string(order[0]) + ", " + std::to_string(order[1]) + ")";
}

/// The largest order up to `order` whose derivative passes the test, -1 when n has no values.
int largest_order(const Scheme& scheme, int order) {
  while (order >= 0 &&
         !own_grid_values(derivative_mask(scheme.exact_mask(), scheme.arity(), Index<1>{order}), Limit::TwoSided))
    --order;
  return order;
}

/// Coefficients of `part` go to every arity-th place of `target`, at residue from its first.
template <Coefficient T, int D>
void interleave(std::vector<T>& target, const Index<D>& first, const Index<D>& size,
                const LaurentPolynomial<T, D>& part, const Index<D>& residue, int arity) {
  if (part.is_zero()) return;
  const int rows = D == 1 ? 1 : part.size()[D - 1];
  std::size_t from = 0;
  for (int y = 0; y < rows; ++y) {
    const int row = D == 1 ? 0 : arity * (part.first()[D - 1] + y) + residue[D - 1] - first[D - 1];
    auto place = static_cast<std::size_t>(row * size[0] + arity * part.first()[0] + residue[0] - first[0]);
    for (int x = 0; x < part.size()[0]; ++x, place += static_cast<std::size_t>(arity))
      target[place] = part.coefficients()[from++];
  }
}

/// s[x] p[x^arity], by the cosets of s: without the zeros of p[x^arity].
template <Coefficient T, int D>
LaurentPolynomial<T, D> refined(const LaurentPolynomial<T, D>& s, const LaurentPolynomial<T, D>& p, int arity) {
  if (p.is_zero()) return p;
  Index<D> first{}, size{}, half{}, shift{};
  std::size_t count = 1;
  for (std::size_t d = 0; d < D; ++d) {
    first[d] = s.first()[d] + arity * p.first()[d];
    size[d] = s.size()[d] + arity * (p.size()[d] - 1);
    count *= static_cast<std::size_t>(size[d]);
    const int twice = s.half()[d] + arity * p.half()[d];
    shift[d] = twice / 2;
    half[d] = twice % 2;
  }
  const LaurentPolynomial<T, D> whole(p.first(), p.size(), {p.coefficients().begin(), p.coefficients().end()});
  std::vector<T> result(count);
  for (int k = 0; k < (D == 1 ? arity : arity * arity); ++k) {
    Index<D> residue{};
    residue[D - 1] = k / arity;  // overwritten in one dimension, where it is 0
    residue[0] = k % arity;
    interleave<T, D>(result, first, size, coset(s, residue, arity) * whole, residue, arity);
  }
  for (std::size_t d = 0; d < D; ++d) first[d] += shift[d];
  return {first, size, std::move(result), half};
}

/// ∂^r Σ_i p[i] n(x - i) on Z^D / arity^level
template <Coefficient T, int D>
LaurentPolynomial<T, D> limits(const DerivativeMask<D>& mask, const LaurentPolynomial<Rational, D>& own_grid,
                               const LaurentPolynomial<T, D>& p, int level) {
  const auto s = converted<T>(mask.mask);
  const bool is_between = level == 0 && mask.mask.half() != Index<D>{};  // integers appear on level 1
  auto refinement = converted<T>(difference_mask<D>(mask.differences)) * p;
  for (int k = 0; k < (is_between ? 1 : level); ++k) refinement = refined(s, refinement, mask.arity);
  const auto scale = integer_power(mask.arity, (is_between ? 1 : level) * total(mask.remaining));
  auto values = converted<T>(scale * own_grid) * refinement;
  return is_between ? coset(values, Index<D>{}, mask.arity) : values;
}

template <Coefficient T, int D>
LaurentPolynomial<T, D> checked_limits(const char* function, const SubdivisionScheme<D>& scheme,
                                       const LaurentPolynomial<T, D>& p, int level, const Index<D>& derivative,
                                       Limit limit) {
  if (level < 0)
    throw InvalidInput(std::string(function) + ": the level must not be negative, found " + std::to_string(level));
  const auto& s = scheme.exact_mask();
  require_affine_invariance(scheme);
  if (s.half() != Index<D>{} && scheme.arity() != 2)
    throw InvalidInput(std::string(function) + ": a mask of arity 3 must have whole powers, found half ones in " +
                       scheme.name());
  const auto mask = derivative_mask(s, scheme.arity(), derivative);
  const auto own_grid = own_grid_values(mask, limit);
  if (!own_grid) throw_missing_derivative(function, scheme, derivative);
  return limits(mask, *own_grid, p, level);
}

}  // namespace

template <int D>
void throw_missing_derivative(const char* function, const SubdivisionScheme<D>& scheme, const Index<D>& derivative) {
  std::string text = std::string(function) + ": " + scheme.name();
  if constexpr (D == 1) {
    const int order = largest_order(scheme, derivative[0] - 1);
    text += order < 0 ? " is not continuous" : " is at most C^" + std::to_string(order);
  } else {
    text += derivative == Index<2>{} ? " is not continuous" : " is not so smooth";
  }
  throw InvalidInput(text + ": " + order_text(derivative));
}

template <int D>
LaurentPolynomial<Rational, D> values_at_integers(const SubdivisionScheme<D>& scheme, const Index<D>& derivative,
                                                  Limit limit) {
  return checked_limits("values_at_integers", scheme, LaurentPolynomial<Rational, D>::constant(1), 0, derivative,
                        limit);
}

template <int D>
LaurentPolynomial<Rational, D> values_at_level(const SubdivisionScheme<D>& scheme, int level,
                                               const Index<D>& derivative, Limit limit) {
  return checked_limits("values_at_level", scheme, LaurentPolynomial<Rational, D>::constant(1), level, derivative,
                        limit);
}

template <Coefficient T, int D>
LaurentPolynomial<T, D> limit_values(const SubdivisionScheme<D>& scheme, const LaurentPolynomial<T, D>& p, int level,
                                     const Index<D>& derivative) {
  if (p.half() != Index<D>{})
    throw InvalidInput("limit_values: control points must lie on integers, found half powers");
  return checked_limits("limit_values", scheme, p, level, derivative, Limit::TwoSided);
}

template void throw_missing_derivative(const char*, const Scheme&, const Index<1>&);
template void throw_missing_derivative(const char*, const Scheme2&, const Index<2>&);
template Mask<Rational> values_at_integers(const Scheme&, const Index<1>&, Limit);
template Mask2<Rational> values_at_integers(const Scheme2&, const Index<2>&, Limit);
template Mask<Rational> values_at_level(const Scheme&, int, const Index<1>&, Limit);
template Mask2<Rational> values_at_level(const Scheme2&, int, const Index<2>&, Limit);
template Mask<Rational> limit_values(const Scheme&, const Mask<Rational>&, int, const Index<1>&);
template Mask2<Rational> limit_values(const Scheme2&, const Mask2<Rational>&, int, const Index<2>&);
template Mask<double> limit_values(const Scheme&, const Mask<double>&, int, const Index<1>&);
template Mask2<double> limit_values(const Scheme2&, const Mask2<double>&, int, const Index<2>&);

}  // namespace batten
