// SPDX-License-Identifier: MIT
#include <batten/bases/bspline_scheme.h>
#include <batten/bases/derivative_mask.h>
#include <batten/domains/errors.h>

#include <cmath>

namespace batten {
namespace {

constexpr int largest_order = 64;

void require_order(const char* function, int order) {
  if (order < 1 || order > largest_order)
    throw InvalidInput(std::string(function) + ": the order must be 1 to " + std::to_string(largest_order) +
                       ", found " + std::to_string(order));
}

Rational factorial(int n) {
  Integer product = 1;
  for (int k = 2; k <= n; ++k) product *= k;
  return Rational(product);
}

}  // namespace

Mask<Rational> bspline_mask(int order, int arity) {
  require_order("bspline_mask", order);
  if (arity != 2 && arity != 3)
    throw InvalidInput("bspline_mask: the arity must be 2 or 3, found " + std::to_string(arity));
  const std::vector<Rational> mean(static_cast<std::size_t>(arity), Rational(1, arity));
  return Rational(arity) * power(Mask<Rational>(0, mean), order);
}

Scheme bspline_scheme(int order, int arity) {
  const auto mask = bspline_mask(order, arity);
  return {"bspline " + std::to_string(order),
          mask,
          arity,
          {.directions = std::vector<Index<1>>(static_cast<std::size_t>(order), Index<1>{1})}};
}

Mask<Rational> lane_riesenfeld(const Mask<Rational>& p, int order) {
  require_order("lane_riesenfeld", order);
  auto result = Rational(2) * upsampled(p, 2);
  const Mask<Rational> average(0, {Rational(1, 2), Rational(1, 2)});
  for (int i = 0; i < order; ++i) result *= average;
  return result;
}

Rational truncated_power(int order, const Rational& x) {
  require_order("truncated_power", order);
  return x < 0 ? Rational(0) : Rational(integer_power(x, order - 1) / factorial(order - 1));
}

Mask<Rational> bspline_difference_mask(int order) {
  require_order("bspline_difference_mask", order);
  return power(Mask<Rational>(0, {1, -1}), order);
}

Rational bspline_value(int order, const Rational& x, int r) {
  require_order("bspline_value", order);
  if (r < 0 || r >= order)
    throw InvalidInput("bspline_value: a B-spline of order " + std::to_string(order) + " has derivatives 0 to " +
                       std::to_string(order - 1) + ", found " + std::to_string(r));
  if (x < 0 || x >= order) return 0;
  const auto d = bspline_difference_mask(order);
  Rational value = 0;
  for (int i = 0; i <= order && x >= i; ++i) value += d[i] * integer_power(x - i, order - 1 - r);
  return value / factorial(order - 1 - r);
}

double bspline_value(int order, double x, int r) {
  if (!std::isfinite(x)) throw InvalidInput("bspline_value: the position must be finite");
  if (x < 0 || x >= order) return static_cast<double>(bspline_value(order, Rational(-1), r));  // 0, arguments checked
  return static_cast<double>(bspline_value(order, Rational(x), r));
}

}  // namespace batten
