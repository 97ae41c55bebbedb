// SPDX-License-Identifier: MIT
#include <batten/bases/box_spline.h>
#include <batten/bases/difference_scheme.h>
#include <batten/bases/index_box.h>
#include <batten/bases/leading_products.h>
#include <batten/bases/mask_text.h>
#include <batten/bases/mask_values.h>
#include <batten/bases/matrix_difference_scheme.h>
#include <batten/bases/smoothness.h>
#include <batten/bases/sum_rules.h>
#include <batten/bases/transition.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

Rational inverse_power(int base, int n) {
  Rational result = 1;
  for (int k = 0; k < n; ++k) result /= base;
  return result;
}

template <int D>
std::optional<CosetDefect<D>> coset_defect(const LaurentPolynomial<Rational, D>& s, int arity) {
  for (const Index<D>& residue : digits<D>(arity)) {
    const Rational total = sum(coset(s, residue, arity));
    if (total != 1) return CosetDefect<D>{residue, total};
  }
  return std::nullopt;
}

/// Where the limits may fail to be C^m: grid points, and what the transition matrices say.
template <int D>
std::vector<FixedPoint<D>> suspects(const LaurentPolynomial<Rational, D>& s, int arity, int m, int sum_rules) {
  std::vector<FixedPoint<D>> points = grid_fixed_points<D>(arity);
  const int order = std::min(m + 1, sum_rules);
  std::vector<Eigen::MatrixXd> matrices;
  for (const auto& a : transition_matrices(s, arity, transition_window(s, arity, order), order))
    matrices.push_back(to_double(a));
  const double threshold = std::pow(arity, -m) * (1 - 1e-6);
  constexpr std::size_t most = 6;
  for (const MatrixProduct& product : leading_products(matrices, D == 1 ? 2000 : 300))
    if (product.rate >= threshold && product.factors.size() > 1 && points.size() < most)
      points.push_back(fixed_point<D>(product.factors, arity));
  return points;
}

template <int D>
std::optional<Roughness<D>> obstacle_to(int m, const LaurentPolynomial<Rational, D>& s, int arity, int sum_rules) {
  const LocalData data = m == 0 ? LocalData::Coefficients : LocalData::Limits;
  for (const FixedPoint<D>& point : suspects(s, arity, m, sum_rules)) {
    const Rational radius = inverse_power(arity, m * point.steps);
    const auto characteristic = local_characteristic_polynomial(s, arity, point, data);
    if (has_rough_eigenvalue<D>(characteristic, radius, point.steps, arity)) return Roughness<D>{point, radius};
  }
  return std::nullopt;
}

/// The ways to choose T, cheap ones first. In one dimension there is one.
template <int D>
std::vector<MatrixDifferenceOptions> choices(int order) {
  if constexpr (D == 1)
    return {{.order = order}};
  else
    return {
        {.order = order}, {.order = order, .margin = 1}, {.order = order, .steps = 2}, {.order = order, .steps = 3}};
}

template <int D>
std::optional<Contraction<D>> contraction_of(int order, const LaurentPolynomial<Rational, D>& s, int arity, int most) {
  for (const MatrixDifferenceOptions& choice : choices<D>(order)) {
    auto t = matrix_difference_scheme(s, choice, arity);
    int coarse = 1;
    for (int n = 0; n < choice.steps; ++n) coarse *= arity;
    const auto norms = norms_until_contraction(t, most / choice.steps, coarse);
    if (norms.back() < 1)
      return Contraction<D>{order, choice.steps, static_cast<int>(norms.size()), norms.back(), std::move(t)};
  }
  return std::nullopt;
}

template <int D>
Smoothness<D> verdict_from_mask(const LaurentPolynomial<Rational, D>& s, int arity, const SmoothnessOptions& options) {
  const int most = D == 1 ? options.largest_power : options.largest_power_2d;
  Smoothness<D> verdict;
  verdict.coset_defect = coset_defect(s, arity);
  if (verdict.coset_defect) return verdict;
  const int sum_rules = sum_rule_order(s, arity);
  for (int m = 0; m <= options.largest_continuity; ++m) {
    if (options.seek_obstacles) verdict.obstacle = obstacle_to(m, s, arity, sum_rules);
    if (verdict.obstacle || m >= sum_rules) return verdict;
    auto proof = contraction_of(m + 1, s, arity, most);
    verdict.tried = most;
    if (!proof) return verdict;
    verdict.proof.push_back(std::move(*proof));
    verdict.continuity = m;
    verdict.tried = 0;
  }
  return verdict;
}

template <int D>
std::string contraction_text(const Contraction<D>& proof) {
  const std::string rounds = proof.steps > 1 ? " of " + std::to_string(proof.steps) + " rounds" : "";
  const std::string power = proof.power > 1 ? "^" + std::to_string(proof.power) : "";
  return "‖T_" + std::to_string(proof.order) + power + "‖" + rounds + " = " + proof.norm.str() + " < 1";
}

template <int D>
std::string roughness_text(const Roughness<D>& obstacle, int arity) {
  const int period = static_cast<int>(std::lround(std::pow(arity, obstacle.point.steps))) - 1;
  const bool at_zero = obstacle.point.shift == Index<D>{};
  const std::string place = at_zero ? "0" : index_text<D>(obstacle.point.shift) + "/" + std::to_string(period);
  const std::string rounds = obstacle.point.steps > 1 ? std::to_string(obstacle.point.steps) + " rounds" : "a round";
  return "at x = " + place + " limits other than polynomials scale by |λ| >= " + obstacle.radius.str() + " in " +
         rounds;
}

}  // namespace

template <int D>
FixedPoint<D> fixed_point(const std::vector<int>& factors, int arity) {
  const auto all = digits<D>(arity);
  FixedPoint<D> point{static_cast<int>(factors.size()), {}};
  int period = 1;
  for (int e : factors) {
    for (std::size_t d = 0; d < D; ++d) point.shift[d] = arity * point.shift[d] + all[static_cast<std::size_t>(e)][d];
    period *= arity;
  }
  for (int& shift : point.shift) shift %= period - 1;  // 1 is a grid point like 0
  return point;
}

template <int D>
std::vector<FixedPoint<D>> grid_fixed_points(int arity) {
  IndexBox<D> shifts;
  shifts.last.fill(arity - 2);
  std::vector<FixedPoint<D>> points;
  for (const Index<D>& shift : indices_of(shifts)) points.push_back({1, shift});
  return points;
}

template <int D>
bool has_box_factors(const LaurentPolynomial<Rational, D>& s, const std::vector<Index<D>>& directions) {
  using Polynomial = LaurentPolynomial<Rational, D>;
  if (std::count(directions.begin(), directions.end(), Index<D>{}) > 0) return false;  // would count for nothing
  Polynomial product = Polynomial::constant(Rational(1 << D));
  for (const Index<D>& d : directions)
    product *= (Polynomial::constant(1) + Polynomial::monomial(d, 1)) * Rational(1, 2);
  Index<D> shift = s.first();
  for (std::size_t d = 0; d < D; ++d) shift[d] -= product.first()[d];
  return shifted(product, shift) == without_half_shift(s);
}

template <int D>
std::optional<BoxFactors<D>> box_factors(const SubdivisionScheme<D>& scheme) {
  const auto& directions = scheme.structure().directions;
  const auto& s = scheme.exact_mask();
  if (directions.empty() || scheme.arity() != 2 || !has_box_factors<D>(s, directions)) return std::nullopt;
  if (coset_defect(without_half_shift(s), 2)) return std::nullopt;
  auto convergence = contraction_of(1, without_half_shift(s), 2, SmoothnessOptions{}.largest_power_2d);
  if (!convergence) return std::nullopt;
  return BoxFactors<D>{directions, std::move(*convergence)};
}

template <int D>
Smoothness<D> smoothness(const SubdivisionScheme<D>& scheme, const SmoothnessOptions& options) {
  auto verdict = verdict_from_mask(without_half_shift(scheme.exact_mask()), scheme.arity(), options);
  if (verdict.is_decided()) return verdict;
  verdict.box = box_factors(scheme);
  if (verdict.box) verdict.continuity = box_continuity(verdict.box->directions);
  return verdict;
}

template <int D>
std::string explanation(const Smoothness<D>& verdict, int arity) {
  const std::string next = "C^" + std::to_string(verdict.continuity + 1);
  if (verdict.box)
    return "C^" + std::to_string(verdict.continuity) + " and not " + next + " because it is the box spline of " +
           std::to_string(verdict.box->directions.size()) + " directions";
  std::string text;
  if (verdict.continuity >= 0)
    text = "C^" + std::to_string(verdict.continuity) + " because " + contraction_text(verdict.proof.back()) + "; ";
  if (verdict.coset_defect)
    return "not convergent because coset " + index_text<D>(verdict.coset_defect->coset) + " of the mask sums to " +
           verdict.coset_defect->sum.str();
  if (verdict.obstacle)
    return text + (verdict.continuity < 0 ? "not convergent" : "not " + next) + " because " +
           roughness_text(*verdict.obstacle, arity);
  if (verdict.tried == 0) return text + next + " undecided: the sum rules are missing";
  return text + next + " undecided up to n = " + std::to_string(verdict.tried);
}

template struct Smoothness<1>;
template struct Smoothness<2>;
template Smoothness<1> smoothness(const Scheme&, const SmoothnessOptions&);
template Smoothness<2> smoothness(const Scheme2&, const SmoothnessOptions&);
template std::string explanation(const Smoothness<1>&, int);
template std::string explanation(const Smoothness<2>&, int);
template std::optional<BoxFactors<1>> box_factors(const Scheme&);
template std::optional<BoxFactors<2>> box_factors(const Scheme2&);
template bool has_box_factors<1>(const Mask<Rational>&, const std::vector<Index<1>>&);
template bool has_box_factors<2>(const Mask2<Rational>&, const std::vector<Index<2>>&);
template FixedPoint<1> fixed_point<1>(const std::vector<int>&, int);
template FixedPoint<2> fixed_point<2>(const std::vector<int>&, int);
template std::vector<FixedPoint<1>> grid_fixed_points<1>(int);
template std::vector<FixedPoint<2>> grid_fixed_points<2>(int);

}  // namespace batten
