// SPDX-License-Identifier: MIT
#include <batten/bases/scaling_function.h>
#include <batten/bases/scaling_values.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace batten {
namespace {

constexpr int most_exact_rounds = 1100;  // binary digits of a double after the point: at most 1074
constexpr double epsilon = std::numeric_limits<double>::epsilon();

Integer floor_of(const Rational& x) {
  const Integer quotient = numerator(x) / denominator(x);  // towards zero
  return x < 0 && Rational(quotient) != x ? Integer(quotient - 1) : quotient;
}

/// f(t + i), i in the window, exact; t is a multiple of arity^-k for some k.
template <int D>
std::vector<Rational> exact_descent(const DerivativeMask<D>& mask, const LaurentPolynomial<Rational, D>& own_grid,
                                    Coordinates<Rational, D> t) {
  std::vector<Index<D>> digits;
  const auto is_zero = [](const Rational& r) { return r == 0; };
  while (!std::all_of(t.begin(), t.end(), is_zero)) {
    if (static_cast<int>(digits.size()) == most_exact_rounds)
      throw InvalidInput("value_at: the coordinates times a power of the arity must be integers, found others");
    auto& digit = digits.emplace_back();
    for (std::size_t d = 0; d < D; ++d) {
      const Rational next = mask.arity * t[d];
      digit[d] = static_cast<int>(floor_of(next));
      t[d] = next - digit[d];
    }
  }
  const auto window = support_window(mask.mask, mask.arity);
  const Rational factor = integer_power(mask.arity, total(mask.remaining));
  auto values = windowed(own_grid, window);
  for (std::size_t k = digits.size(); k-- > 0;) {
    values = descended<Rational>(mask.mask, mask.arity, digits[k], window, values);
    if (factor != 1)
      for (auto& v : values) v *= factor;
  }
  return values;
}

/// d * the values of a window, at i: Σ_j d[j] values[i - j].
template <Coefficient T, int D>
LaurentPolynomial<T, D> combined(const LaurentPolynomial<T, D>& d, const SupportWindow<D>& window,
                                 std::vector<T> values) {
  return d * LaurentPolynomial<T, D>(window.lower, window.size, std::move(values));
}

/// The shift of the scaling function that the dropped half shifts of its mask stand for.
template <int D>
Rational half_shift(const LaurentPolynomial<Rational, D>& s, int arity, std::size_t d) {
  return Rational(s.half()[d], 2 * (arity - 1));
}

}  // namespace

template <int D>
ScalingFunction<D>::ScalingFunction(const SubdivisionScheme<D>& scheme, const Index<D>& derivative) {
  require_affine_invariance(scheme);
  const int arity = scheme.arity();
  mask_ = derivative_mask(scheme.exact_mask(), arity, derivative);
  if (arity != 2 && (mask_.remaining != Index<D>{} || mask_.mask.half() != Index<D>{}))
    throw InvalidInput(
        "ScalingFunction: at arity 3 the mask must have whole powers and a factor 1 + x + x^2 for each "
        "derivative, found that of " +
        scheme.name());
  auto own_grid = own_grid_values(mask_, Limit::TwoSided);
  if (!own_grid) throw_missing_derivative("ScalingFunction", scheme, derivative);
  own_grid_ = std::move(*own_grid);
  real_mask_ = to_double(mask_.mask);
  differences_ = to_double(difference_mask<D>(mask_.differences));
  window_ = support_window(mask_.mask, arity);
  at_integers_ = windowed(to_double(own_grid_), window_);
  if (mask_.remaining == Index<D>{}) bound_ = descent_bound(real_mask_, arity, to_double(own_grid_));
}

template <int D>
typename ScalingFunction<D>::Descent ScalingFunction<D>::descend(std::array<Digits, D> t) const {
  const auto is_done = [&] { return std::all_of(t.begin(), t.end(), [](const Digits& r) { return r.is_zero(); }); };
  const std::size_t kept = mask_.arity == 2 ? 120 : 75;  // digits in 120 bits
  const double shrinking = -std::log2(bound_.ratio) / bound_.rounds;
  const auto wanted = static_cast<std::size_t>(std::min(53 / std::max(shrinking, 0.1), 120.));
  const std::size_t most = std::min(kept, std::max<std::size_t>(60, wanted));
  std::vector<Index<D>> digits;
  while (digits.size() < most && !is_done()) {
    auto& digit = digits.emplace_back();
    for (std::size_t d = 0; d < D; ++d) digit[d] = t[d].next(mask_.arity);
  }
  auto values = at_integers_;
  for (std::size_t k = digits.size(); k-- > 0;)
    values = descended<double>(real_mask_, mask_.arity, digits[k], window_, values);
  return {std::move(values), error_bound(static_cast<int>(digits.size()), !is_done())};
}

template <int D>
typename ScalingFunction<D>::Descent ScalingFunction<D>::descend_exactly(const Coordinates<double, D>& x) const {
  Coordinates<Rational, D> t;
  for (std::size_t d = 0; d < D; ++d) {
    const Rational from_start = Rational(x[d]) - half_shift(mask_.mask, mask_.arity, d);
    t[d] = from_start - Rational(floor_of(from_start));
  }
  Descent result{{}, 0};
  for (const auto& v : exact_descent(mask_, own_grid_, t)) result.values.push_back(static_cast<double>(v));
  return result;
}

/// The bound of the class's comment for each value: the rounding of each round is amplified by the rounds after it.
template <int D>
double ScalingFunction<D>::error_bound(int rounds, bool is_cut) const {
  double largest = 0;
  for (double v : at_integers_) largest = std::max(largest, std::abs(v));
  double terms = 1;  // of a sum, at most
  for (int n : real_mask_.size()) terms *= n / mask_.arity + 1;
  const double size = largest + bound_.oscillation;  // of the function
  const double rounding = (rounds * (terms + 2) * bound_.amplification + 1) * epsilon * size * bound_.amplification;
  const double cut = is_cut ? bound_.amplification * bound_.oscillation *
                                  std::pow(bound_.ratio, std::floor(static_cast<double>(rounds) / bound_.rounds))
                            : 0;
  return rounding + cut;
}

template <int D>
typename ScalingFunction<D>::Basis ScalingFunction<D>::at(const Coordinates<double, D>& x) const {
  std::array<Digits, D> t;
  for (std::size_t d = 0; d < D; ++d) {
    if (!(std::abs(x[d]) < 1e9))
      throw InvalidInput("ScalingFunction: coordinates must be finite and below 10^9, found " + std::to_string(x[d]));
    t[d] = Digits(x[d], mask_.mask.half()[d] != 0);
  }
  Descent descent = mask_.remaining == Index<D>{} ? descend(t) : descend_exactly(x);
  double largest = 0;
  for (double v : descent.values) largest = std::max(largest, std::abs(v));
  const int order = total(mask_.differences);  // its differences add up 2^order values
  const double error = std::ldexp(descent.error + (order + 2) * epsilon * largest, order);
  const auto values = combined(differences_, window_, std::move(descent.values));
  Basis basis{{}, values.size(), {values.coefficients().rbegin(), values.coefficients().rend()}, error};
  const Index<D> last = values.last();
  for (std::size_t d = 0; d < D; ++d) basis.first[d] = t[d].cell() - last[d];  // n(x - i) = f(t + cell - i)
  return basis;
}

template <int D>
BoundedValue ScalingFunction<D>::operator()(const Coordinates<double, D>& x) const {
  const Basis basis = at(x);
  std::size_t place = 0;
  for (std::size_t d = D; d-- > 0;) {
    const int i = -basis.first[d];
    if (i < 0 || i >= basis.size[d]) return {0, basis.error};
    place = place * static_cast<std::size_t>(basis.size[d]) + static_cast<std::size_t>(i);
  }
  return {basis.values[place], basis.error};
}

template <int D>
Rational value_at(const SubdivisionScheme<D>& scheme, const Coordinates<Rational, D>& x, const Index<D>& derivative) {
  require_affine_invariance(scheme);
  const auto mask = derivative_mask(scheme.exact_mask(), scheme.arity(), derivative);
  const auto own_grid = own_grid_values(mask, Limit::TwoSided);
  if (!own_grid) throw_missing_derivative("value_at", scheme, derivative);
  Coordinates<Rational, D> t;
  Index<D> cell{};
  for (std::size_t d = 0; d < D; ++d) {
    const Rational from_start = x[d] - half_shift(mask.mask, mask.arity, d);
    const Integer below = floor_of(from_start);
    if (abs(below) > 1'000'000'000) return 0;  // far outside every support
    cell[d] = static_cast<int>(below);
    t[d] = from_start - Rational(below);
  }
  return combined(difference_mask<D>(mask.differences), support_window(mask.mask, mask.arity),
                  exact_descent(mask, *own_grid, t))[cell];
}

template class ScalingFunction<1>;
template class ScalingFunction<2>;
template Rational value_at(const Scheme&, const Coordinates<Rational, 1>&, const Index<1>&);
template Rational value_at(const Scheme2&, const Coordinates<Rational, 2>&, const Index<2>&);

}  // namespace batten
