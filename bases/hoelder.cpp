// SPDX-License-Identifier: MIT
#include <batten/bases/box_spline.h>
#include <batten/bases/difference_scheme.h>
#include <batten/bases/hoelder.h>
#include <batten/bases/invariant_polytope.h>
#include <batten/bases/leading_products.h>
#include <batten/bases/smoothness.h>
#include <batten/bases/sum_rules.h>
#include <batten/bases/transition.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

constexpr double rounding = 1e-12;  // more than that of the logarithms here

/// -log(radius) / log(base).
double exponent(const Rational& radius, double base) { return -std::log(static_cast<double>(radius)) / std::log(base); }

/// arity^-n when the number is one to 1e-6, n an integer; otherwise the number less a share of it.
Rational plausible_radius(double number, int arity, double share) {
  const double n = -std::log(number) / std::log(arity);
  if (std::abs(n - std::round(n)) > 1e-6) return Rational(number * (1 - share));
  Rational radius = 1;
  for (int k = 0; k < static_cast<int>(std::lround(n)); ++k) radius /= arity;
  return radius;
}

template <int D>
std::optional<Roughness<D>> rough_point(const LaurentPolynomial<Rational, D>& s, int arity, const FixedPoint<D>& point,
                                        double rate) {
  const auto characteristic = local_characteristic_polynomial(s, arity, point, LocalData::Limits);
  const double number = std::pow(rate, point.steps);
  for (double share : {1e-9, 1e-6, 1e-4, 1e-3}) {
    const Rational radius = std::min(Rational(1), plausible_radius(number, arity, share));
    if (has_rough_eigenvalue<D>(characteristic, radius, point.steps, arity)) return Roughness<D>{point, radius};
  }
  return std::nullopt;
}

/// The leading products' fixed points in turn, until the limits at one of them scale as the product does.
template <int D>
Roughness<D> roughest_point(const LaurentPolynomial<Rational, D>& s, int arity,
                            const std::vector<MatrixProduct>& products) {
  constexpr std::size_t most = 8;  // beyond the first few products the search is long and seldom of use
  for (std::size_t k = 0; k < std::min(most, products.size()); ++k) {
    const MatrixProduct& product = products[k];
    const auto point =
        product.factors.size() == 1 ? grid_fixed_points<D>(arity) : std::vector{fixed_point<D>(product.factors, arity)};
    for (const FixedPoint<D>& at : point)
      if (const auto found = rough_point(s, arity, at, product.rate)) return *found;
  }
  throw SolverError("hoelder_bounds: found no upper bound, at no fixed point do limits scale as data do");
}

/// Radii above the rate in turn, the best proof that is found in time.
template <int D>
InvariantPolytope<D> polytope_near(double rate, const std::vector<RationalMatrix>& matrices, int arity,
                                   const HoelderOptions& options) {
  const bool small = matrices.front().rows() <= 12;
  std::vector<double> gaps = {options.gap, 2 * options.gap, 0.2, 0.4};
  if (small) gaps.insert(gaps.begin(), {1e-4, 0.1 * options.gap});
  for (double gap : gaps) {
    PolytopeSearch search{Rational(rate * std::pow(arity, gap))};
    search.most_vertices = gap < options.gap ? std::min(200, options.most_vertices) : options.most_vertices;
    for (const Rational& unit : {Rational(1, 1000), Rational(3, 100), Rational(1, 10000)}) {
      search.unit = unit;
      if (auto found = invariant_polytope<D>(matrices, search)) return std::move(*found);
      if (gap < options.gap) break;
    }
  }
  throw SolverError("hoelder_bounds: found no lower bound, no polytope of " + std::to_string(options.most_vertices) +
                    " vertices is kept");
}

}  // namespace

template <int D>
double exponent_of(const InvariantPolytope<D>& polytope, int arity) {
  return std::min<double>(polytope.order, exponent(polytope.radius, arity) - rounding);
}

template <int D>
double exponent_of(const Roughness<D>& roughness, int arity) {
  return exponent(roughness.radius, std::pow(arity, roughness.point.steps)) + rounding;
}

template <int D>
HoelderBounds<D> hoelder_bounds(const SubdivisionScheme<D>& scheme, const HoelderOptions& options) {
  const int arity = scheme.arity();
  const auto s = without_half_shift(scheme.exact_mask());
  if (auto box = box_factors(scheme)) {
    const double exponent = box_continuity(box->directions) + 1;
    return {exponent, exponent, {}, {}, std::move(box)};
  }
  const int order = sum_rule_order(s, arity);
  if (order == 0) {
    require_affine_invariance(scheme);
    throw InvalidInput("hoelder_bounds: sum rules of order 1 are needed, found none");
  }
  const auto window = transition_window(s, arity, order);
  const auto matrices = transition_matrices(s, arity, window, order);
  std::vector<Eigen::MatrixXd> rounded;
  for (const RationalMatrix& a : matrices) rounded.push_back(to_double(a));
  const auto products = leading_products(rounded, D == 1 ? 2000 : 300);
  if (products.front().rate >= 1 - 1e-9)
    throw SolverError("hoelder_bounds: a convergent scheme is needed, found that differences of order " +
                      std::to_string(order) + " do not shrink");
  HoelderBounds<D> bounds;
  bounds.upper_proof = roughest_point(s, arity, products);
  bounds.lower_proof = polytope_near<D>(products.front().rate, matrices, arity, options);
  bounds.lower_proof.order = order;
  bounds.lower_proof.window = window;
  bounds.lower = exponent_of(bounds.lower_proof, arity);
  bounds.upper = exponent_of(bounds.upper_proof, arity);
  return bounds;
}

template struct HoelderBounds<1>;
template struct HoelderBounds<2>;
template HoelderBounds<1> hoelder_bounds(const Scheme&, const HoelderOptions&);
template HoelderBounds<2> hoelder_bounds(const Scheme2&, const HoelderOptions&);
template double exponent_of(const InvariantPolytope<1>&, int);
template double exponent_of(const InvariantPolytope<2>&, int);
template double exponent_of(const Roughness<1>&, int);
template double exponent_of(const Roughness<2>&, int);

}  // namespace batten
