// SPDX-License-Identifier: MIT
#include <batten/bases/convergence_bound.h>
#include <batten/bases/derivative_mask.h>
#include <batten/bases/difference_scheme.h>
#include <batten/bases/mask_division.h>
#include <batten/bases/mask_values.h>
#include <batten/bases/matrix_difference_scheme.h>
#include <batten/bases/transition.h>
#include <batten/domains/errors.h>

#include <algorithm>

namespace batten {
namespace {

/// The mask of linear interpolation, (1 + ... + x^(arity-1))² x^(1-arity) / arity.
Mask<Rational> linear_mask(int arity) {
  const Mask<Rational> box(0, std::vector<Rational>(static_cast<std::size_t>(arity), 1));
  return shifted(power(box, 2), {1 - arity}) * Rational(1, arity);
}

/// ‖A‖, A with least norm: a row for each coset.
Rational least_deviation(const Mask<Rational>& s, int arity) {
  const Mask<Rational> coarse_difference = upsampled(Mask<Rational>(0, {1, -1}), arity);
  const Mask<Rational> a = exact_quotient(s - linear_mask(arity), coarse_difference);
  Rational most = 0;
  for (int r = 0; r < arity; ++r) most = std::max(most, absolute_sum(coset(a, r, arity)));
  return most;
}

Rational least_deviation(const Mask2<Rational>& s, int arity) {
  const auto difference = s - tensor_product(linear_mask(arity), linear_mask(arity));
  Rational most = 0;
  for (const Index<2>& r : digits<2>(arity)) {
    Rational norm = 0;
    for (const auto& a : least_difference_row(coset(difference, r, arity), 1)) norm += absolute_sum(a);
    most = std::max(most, norm);
  }
  return most;
}

}  // namespace

Rational geometric_tail(const Rational& beta, const Rational& alpha, int k) {
  if (alpha < 0 || alpha >= 1 || k < 0)
    throw InvalidInput("geometric_tail: 0 <= alpha < 1 and k >= 0 must hold, found alpha = " + alpha.str() +
                       " and k = " + std::to_string(k));
  return beta * integer_power(alpha, k) / (1 - alpha);
}

Rational ConvergenceBound::factor(int k) const {
  const int n = static_cast<int>(norms.size()) - 1;
  Rational round = 0;
  for (int r = 0; r < n; ++r) round += norms[static_cast<std::size_t>(r)];
  return geometric_tail(deviation * round, norms.back(), k < 0 ? k : k / n);
}

template <int D>
ConvergenceBound convergence_bound(const SubdivisionScheme<D>& scheme) {
  const auto s = without_half_shift(scheme.exact_mask());
  require_affine_invariance(scheme);
  const auto t = matrix_difference_scheme(s, {.order = 1}, scheme.arity());
  const auto norms = norms_until_contraction(t, D == 1 ? 12 : 6, scheme.arity());
  if (norms.back() >= 1)
    throw SolverError("convergence_bound: the differences of " + scheme.name() +
                      " must shrink, found no power of their scheme with a norm below 1");
  ConvergenceBound bound{least_deviation(s, scheme.arity()), {1}};
  bound.norms.insert(bound.norms.end(), norms.begin(), norms.end());
  return bound;
}

template ConvergenceBound convergence_bound(const Scheme&);
template ConvergenceBound convergence_bound(const Scheme2&);

}  // namespace batten
