// SPDX-License-Identifier: MIT
#include <batten/bases/derivative_mask.h>
#include <batten/bases/scaling_pieces.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <string>

namespace batten {
namespace {

using Polynomial = std::vector<Rational>;

/// p(a + b u), by Horner's rule.
Polynomial composed(const Polynomial& p, const Rational& a, const Rational& b) {
  Polynomial result(p.size());
  for (std::size_t k = p.size(); k-- > 0;) {
    for (std::size_t i = p.size(); i-- > 0;)
      result[i] = a * result[i] + (i > 0 ? Rational(b * result[i - 1]) : Rational(0));
    result[0] += p[k];
  }
  return result;
}

/// The polynomial with values[j] at j step, by divided differences.
Polynomial interpolant(Polynomial values, const Rational& step) {
  const std::size_t n = values.size();
  for (std::size_t order = 1; order < n; ++order)
    for (std::size_t j = n; j-- > order;) values[j] = (values[j] - values[j - 1]) / (step * static_cast<long>(order));
  Polynomial result(n);
  for (std::size_t k = n; k-- > 0;) {  // result (u - k step) + values[k]
    for (std::size_t i = n; i-- > 0;)
      result[i] = (i > 0 ? result[i - 1] : Rational(0)) - step * static_cast<long>(k) * result[i];
    result[0] += values[k];
  }
  return result;
}

/// P_c((t + u) / arity) = Σ_j s[j] P_(arity c + t - j)(u) for all c, t, for a mask from x^0 on.
bool satisfy_refinement(const std::vector<Polynomial>& pieces, const Mask<Rational>& s, int arity) {
  const int count = static_cast<int>(pieces.size());
  for (int c = 0; c < count; ++c)
    for (int t = 0; t < arity; ++t) {
      auto rest = composed(pieces[static_cast<std::size_t>(c)], Rational(t, arity), Rational(1, arity));
      for (int j = 0; j <= s.last()[0]; ++j) {
        const int other = arity * c + t - j;
        if (other < 0 || other >= count) continue;
        for (std::size_t p = 0; p < rest.size(); ++p) rest[p] -= s[j] * pieces[static_cast<std::size_t>(other)][p];
      }
      if (std::any_of(rest.begin(), rest.end(), [](const Rational& r) { return r != 0; })) return false;
    }
  return true;
}

/// Cuts off leading coefficients that are zero in all pieces.
void trim(std::vector<Polynomial>& pieces) {
  const auto ends_in_zero = [](const Polynomial& p) { return p.size() > 1 && p.back() == 0; };
  while (std::all_of(pieces.begin(), pieces.end(), ends_in_zero))
    for (auto& p : pieces) p.pop_back();
}

}  // namespace

std::optional<ScalingPieces> pieces_if_polynomial(const Scheme& scheme) {
  require_affine_invariance(scheme);
  const int arity = scheme.arity();
  const auto& mask = scheme.exact_mask();
  const Mask<Rational> s(0, {mask.coefficients().begin(), mask.coefficients().end()});
  if (s.last()[0] % (arity - 1) != 0) return std::nullopt;
  const int count = s.last()[0] / (arity - 1);  // of intervals; a spline of degree d has at least d + 1
  const auto at_integers = own_grid_values(DerivativeMask<1>{s, arity}, Limit::FromRight);
  if (!at_integers) return std::nullopt;
  int level = 0, steps = 1;
  for (; steps < count; ++level) steps *= arity;
  const auto values = iterated(s, level, arity) * *at_integers;
  std::vector<Polynomial> pieces;
  for (int c = 0; c < count; ++c) {
    Polynomial of_cell;
    for (int j = 0; j < count; ++j) of_cell.push_back(values[c * steps + j]);
    pieces.push_back(interpolant(std::move(of_cell), Rational(1, steps)));
  }
  if (!satisfy_refinement(pieces, s, arity)) return std::nullopt;
  trim(pieces);
  return ScalingPieces{scheme.support().lower[0], std::move(pieces)};
}

ScalingPieces derivative(const ScalingPieces& pieces, int order) {
  if (order < 0) throw InvalidInput("derivative: the order must not be negative, found " + std::to_string(order));
  ScalingPieces result = pieces;
  for (auto& p : result.coefficients)
    for (int r = 0; r < order; ++r) {
      for (std::size_t k = 1; k < p.size(); ++k) p[k - 1] = p[k] * static_cast<long>(k);
      p.back() = 0;
    }
  trim(result.coefficients);
  return result;
}

Rational value(const ScalingPieces& pieces, const Rational& x) {
  const Rational offset = x - pieces.first;
  if (offset < 0 || offset >= static_cast<long>(pieces.coefficients.size())) return 0;
  const Integer c = numerator(offset) / denominator(offset);
  const Rational u = offset - Rational(c);
  Rational sum = 0;
  const auto& p = pieces.coefficients[static_cast<std::size_t>(c)];
  for (std::size_t k = p.size(); k-- > 0;) sum = sum * u + p[k];
  return sum;
}

}  // namespace batten
