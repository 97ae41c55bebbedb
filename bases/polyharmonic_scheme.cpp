// SPDX-License-Identifier: MIT
#include <batten/bases/mask_family.h>
#include <batten/bases/mask_text.h>
#include <batten/bases/mask_values.h>
#include <batten/bases/polyharmonic_coefficients.h>
#include <batten/bases/polyharmonic_scheme.h>
#include <batten/domains/errors.h>

namespace batten {
namespace {

/// ((1 + x)^n / 2^n) · 2 around 0, n = 2 order.
Mask<Rational> spline_mask(int order) {
  Mask<Rational> mask = Mask<Rational>::monomial({-order}, 2);
  for (int k = 0; k < 2 * order; ++k) mask *= Mask<Rational>(0, {Rational(1) / 2, Rational(1) / 2});
  return mask;
}

}  // namespace

Mask2<double> truncated_laurent_mask(int order, int size) {
  require_order("truncated_laurent_mask", order);
  const MaskFamily family(size, MaskSymmetry::Square, MaskShape::Square, 3);
  const int half = (size - 1) / 2;
  std::vector<double> values(static_cast<std::size_t>(family.unknowns()));
  for (int u = 0; u < family.unknowns(); ++u) {
    const auto [i, j] = family.orbit(u).front();
    values[static_cast<std::size_t>(u)] = polyharmonic_coefficient(order, i, j);
  }
  std::vector<double> coefficients;
  for (int j = -half; j <= half; ++j)
    for (int i = -half; i <= half; ++i)
      coefficients.push_back(values[static_cast<std::size_t>(*family.unknown_at({i, j}))]);
  return {{-half, -half}, {size, size}, std::move(coefficients)};
}

Mask2<Rational> with_unit_cosets(const Mask2<double>& s) {
  std::vector<Rational> values(s.coefficients().begin(), s.coefficients().end());
  const Mask2<Rational> exact(s.first(), s.size(), std::move(values));
  Mask2<Rational> result;
  for (const Index<2>& residue : {Index<2>{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
    const auto part = coset(exact, residue);
    const Rational total = sum(part);
    if (total == 0)
      throw InvalidInput("with_unit_cosets: no coset may sum to 0, found " + index_text<2>(residue) + " that does");
    result += Rational(1 / total) * (upsampled(part, 2) * Mask2<Rational>::monomial(residue));
  }
  return result;
}

Mask2<Rational> jacobi_mask(int order, const JacobiOptions& options) {
  require_order("jacobi_mask", order);
  if (options.rounds < 0)
    throw InvalidInput("jacobi_mask: rounds must not be negative, found " + std::to_string(options.rounds));
  Rational a = options.relaxation;
  if (a == 0) a = Rational(1) / (Integer(1) << static_cast<unsigned>(3 * order));
  if (order % 2 == 1) a = -a;
  Mask2<Rational> s = tensor_product(spline_mask(order), spline_mask(order));
  for (int round = 0; round < options.rounds; ++round) s -= a * residual(s, order);
  return s;
}

int jacobi_rounds(int order, int size) {
  require_order("jacobi_rounds", order);
  const int step = 2 * order, beyond = size - step - 1;
  if (beyond < 0 || beyond % step != 0) {
    const int rounds = beyond < 0 ? 0 : beyond / step;
    throw InvalidInput("jacobi_rounds: Jacobi masks of order " + std::to_string(order) + " have sizes " +
                       std::to_string(step * (rounds + 1) + 1) + ", " + std::to_string(step * (rounds + 2) + 1) +
                       ", ..., found " + std::to_string(size));
  }
  return beyond / step;
}

}  // namespace batten
