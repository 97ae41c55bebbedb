// SPDX-License-Identifier: MIT
#include <batten/bases/box_spline.h>
#include <batten/bases/certificate_check.h>
#include <batten/bases/difference_scheme.h>
#include <batten/bases/mask_values.h>
#include <batten/bases/sum_rules.h>
#include <batten/bases/transition.h>
#include <batten/domains/errors.h>

#include <algorithm>

namespace batten {
namespace {

constexpr int most_rounds = 12;  // of a claim: beyond it the check would take too long

std::string order_text(int order) { return "order " + std::to_string(order); }

template <int D>
std::string fault_of_point(const FixedPoint<D>& point, const Rational& radius, int arity) {
  if (point.steps < 1 || point.steps > most_rounds) return "a fixed point needs 1 to 12 rounds";
  int period = 1;
  for (int n = 0; n < point.steps; ++n) period *= arity;
  for (int shift : point.shift)
    if (shift < 0 || shift > std::max(0, period - 2)) return "the fixed point does not lie in [0, 1)";
  if (radius <= 0 || radius > 1) return "the radius does not lie in (0, 1]";
  return "";
}

/// Whether data on the fixed point's window scale as said.
template <int D>
std::string fault_of_scaling(const Roughness<D>& roughness, const LaurentPolynomial<Rational, D>& s, int arity,
                             LocalData data) {
  const auto mask = without_half_shift(s);
  if (data == LocalData::Limits && !grid_values(mask, arity)) return "the limits are not known at grid points";
  const auto characteristic = local_characteristic_polynomial(mask, arity, roughness.point, data);
  if (has_rough_eigenvalue<D>(characteristic, roughness.radius, roughness.point.steps, arity)) return "";
  return "no eigenvalue besides those of polynomials is at least " + roughness.radius.str();
}

/// The vertices of a polytope, the unit vectors first.
template <int D>
std::vector<std::vector<Rational>> all_vertices(const InvariantPolytope<D>& polytope, std::size_t dimension) {
  std::vector<std::vector<Rational>> vertices;
  for (std::size_t i = 0; i < dimension; ++i) {
    vertices.emplace_back(dimension);
    vertices.back()[i] = polytope.unit;
  }
  vertices.insert(vertices.end(), polytope.vertices.begin(), polytope.vertices.end());
  return vertices;
}

/// An upper bound of the gauge of `point`: the combination's weights, and what it misses as unit vectors.
template <int D>
Rational gauge_bound(std::vector<Rational> point, const typename InvariantPolytope<D>::Combination& combination,
                     const std::vector<std::vector<Rational>>& vertices, const Rational& unit) {
  Rational weights = 0, missing = 0;
  for (std::size_t k = 0; k < combination.indices.size(); ++k) {
    const Rational& c = combination.coefficients[k];
    const auto& vertex = vertices[static_cast<std::size_t>(combination.indices[k])];
    for (std::size_t i = 0; i < point.size(); ++i)
      if (vertex[i] != 0) point[i] -= c * vertex[i];
    weights += abs(c);
  }
  for (const Rational& rest : point) missing += abs(rest);
  return weights + missing / unit;
}

template <int D>
bool is_well_formed(const InvariantPolytope<D>& polytope, std::size_t dimension, std::size_t matrices) {
  const auto count = dimension + polytope.vertices.size();
  const auto fits = [&](const typename InvariantPolytope<D>::Combination& image) {
    return image.indices.size() == image.coefficients.size() &&
           std::all_of(image.indices.begin(), image.indices.end(),
                       [&](int k) { return k >= 0 && k < static_cast<int>(count); });
  };
  return polytope.unit > 0 && polytope.radius > 0 && polytope.images.size() == count * matrices &&
         std::all_of(polytope.vertices.begin(), polytope.vertices.end(),
                     [&](const auto& v) { return v.size() == dimension; }) &&
         std::all_of(polytope.images.begin(), polytope.images.end(), fits);
}

}  // namespace

template <int D>
std::string fault_of(const Contraction<D>& proof, const LaurentPolynomial<Rational, D>& s, int arity) {
  if (proof.order < 1 || proof.steps < 1 || proof.power < 1 || proof.steps * proof.power > most_rounds)
    return "a contraction needs an order of at least 1 and 1 to 12 rounds";
  if (!is_difference_scheme(proof.scheme, s, proof.order, proof.steps, arity))
    return "the scheme is not that of differences of " + order_text(proof.order);
  int coarse = 1;
  for (int n = 0; n < proof.steps; ++n) coarse *= arity;
  const Rational norm = iterated_norm(proof.scheme, proof.power, coarse);
  if (norm != proof.norm) return "the norm is " + norm.str() + ", not " + proof.norm.str();
  return norm < 1 ? "" : "the norm " + norm.str() + " is not below 1";
}

template <int D>
std::string fault_of(const Roughness<D>& obstacle, int m, const LaurentPolynomial<Rational, D>& s, int arity) {
  const std::string fault = fault_of_point(obstacle.point, obstacle.radius, arity);
  if (!fault.empty()) return fault;
  if (m < 0) return "smoothness is counted from C^0";
  Rational threshold = 1;
  for (int k = 0; k < m * obstacle.point.steps; ++k) threshold /= arity;
  if (obstacle.radius < threshold) return "the radius must be at least " + threshold.str();
  return fault_of_scaling(obstacle, s, arity, m == 0 ? LocalData::Coefficients : LocalData::Limits);
}

template <int D>
std::string fault_of(const Roughness<D>& roughness, const LaurentPolynomial<Rational, D>& s, int arity) {
  const std::string fault = fault_of_point(roughness.point, roughness.radius, arity);
  return fault.empty() ? fault_of_scaling(roughness, s, arity, LocalData::Limits) : fault;
}

template <int D>
std::string fault_of(const CosetDefect<D>& defect, const LaurentPolynomial<Rational, D>& s, int arity) {
  const Rational found = sum(coset(without_half_shift(s), defect.coset, arity));
  if (found != defect.sum) return "the coset sums to " + found.str();
  return found != 1 ? "" : "the coset sums to 1, as it should";
}

template <int D>
std::string fault_of(const BoxFactors<D>& box, const LaurentPolynomial<Rational, D>& s, int arity) {
  if (arity != 2) return "box splines are known for arity 2";
  if (!has_box_factors<D>(s, box.directions)) return "the mask is not the product over the directions";
  if (box.convergence.order != 1) return "convergence needs a contraction of order 1";
  return fault_of(box.convergence, s, arity);
}

template <int D>
std::string fault_of(const InvariantPolytope<D>& polytope, const LaurentPolynomial<Rational, D>& s, int arity) {
  const auto mask = without_half_shift(s);
  if (polytope.order < 1 || polytope.order > sum_rule_order(mask, arity)) return "the sum rules are missing";
  if (!std::is_sorted(polytope.window.begin(), polytope.window.end()) ||
      std::adjacent_find(polytope.window.begin(), polytope.window.end()) != polytope.window.end())
    return "the window must be in ascending order";
  if (!holds_differences<D>(polytope.window, polytope.order)) return "the window misses differences";
  if (!is_invariant(polytope.window, mask, arity)) return "the window is left by subdivision";
  const auto matrices = transition_matrices(mask, arity, polytope.window, polytope.order);
  const auto dimension = static_cast<std::size_t>(matrices.front().rows());
  if (!is_well_formed(polytope, dimension, matrices.size())) return "sizes and indices do not fit";
  const auto vertices = all_vertices(polytope, dimension);
  for (std::size_t v = 0; v < vertices.size(); ++v)
    for (std::size_t e = 0; e < matrices.size(); ++e) {
      std::vector<Rational> image = matrices[e] * vertices[v];
      for (Rational& x : image) x /= polytope.radius;
      const auto& combination = polytope.images[e + matrices.size() * v];
      if (gauge_bound<D>(std::move(image), combination, vertices, polytope.unit) > 1)
        return "the image of vertex " + std::to_string(v) + " is not shown to lie inside";
    }
  return "";
}

template <int D>
std::string fault_of(const Smoothness<D>& verdict, const LaurentPolynomial<Rational, D>& s, int arity) {
  if (verdict.box) {
    const std::string fault = fault_of(*verdict.box, s, arity);
    if (!fault.empty()) return "box spline: " + fault;
    return verdict.continuity == box_continuity(verdict.box->directions) ? "" : "the box spline is not so smooth";
  }
  if (verdict.continuity < -1 || verdict.proof.size() != static_cast<std::size_t>(verdict.continuity + 1))
    return "each order up to " + std::to_string(verdict.continuity + 1) + " needs its contraction";
  for (std::size_t k = 0; k < verdict.proof.size(); ++k) {
    if (verdict.proof[k].order != static_cast<int>(k) + 1) return "the orders of the contractions must be 1, 2, ...";
    const std::string fault = fault_of(verdict.proof[k], s, arity);
    if (!fault.empty()) return order_text(static_cast<int>(k) + 1) + ": " + fault;
  }
  if (verdict.coset_defect) {
    const std::string fault = fault_of(*verdict.coset_defect, s, arity);
    if (!fault.empty()) return "coset: " + fault;
  }
  if (!verdict.obstacle) return "";
  const std::string fault = fault_of(*verdict.obstacle, verdict.continuity + 1, s, arity);
  return fault.empty() ? "" : "obstacle: " + fault;
}

template <int D>
std::string fault_of(const HoelderBounds<D>& bounds, const LaurentPolynomial<Rational, D>& s, int arity) {
  if (bounds.box) {
    const std::string fault = fault_of(*bounds.box, s, arity);
    if (!fault.empty()) return "box spline: " + fault;
    const double exponent = box_continuity(bounds.box->directions) + 1;
    return bounds.lower <= exponent && exponent <= bounds.upper ? "" : "the box spline has another exponent";
  }
  if (bounds.lower_proof.radius >= 1) return "the polytope does not prove convergence";
  const std::string lower = fault_of(bounds.lower_proof, s, arity);
  if (!lower.empty()) return "lower bound: " + lower;
  if (bounds.lower > exponent_of(bounds.lower_proof, arity)) return "the lower bound is larger than what is proved";
  const std::string upper = fault_of(bounds.upper_proof, s, arity);
  if (!upper.empty()) return "upper bound: " + upper;
  if (bounds.upper < exponent_of(bounds.upper_proof, arity)) return "the upper bound is smaller than what is proved";
  return "";
}

template std::string fault_of(const Contraction<1>&, const Mask<Rational>&, int);
template std::string fault_of(const Contraction<2>&, const Mask2<Rational>&, int);
template std::string fault_of(const Roughness<1>&, int, const Mask<Rational>&, int);
template std::string fault_of(const Roughness<2>&, int, const Mask2<Rational>&, int);
template std::string fault_of(const Roughness<1>&, const Mask<Rational>&, int);
template std::string fault_of(const Roughness<2>&, const Mask2<Rational>&, int);
template std::string fault_of(const CosetDefect<1>&, const Mask<Rational>&, int);
template std::string fault_of(const CosetDefect<2>&, const Mask2<Rational>&, int);
template std::string fault_of(const BoxFactors<1>&, const Mask<Rational>&, int);
template std::string fault_of(const BoxFactors<2>&, const Mask2<Rational>&, int);
template std::string fault_of(const InvariantPolytope<1>&, const Mask<Rational>&, int);
template std::string fault_of(const InvariantPolytope<2>&, const Mask2<Rational>&, int);
template std::string fault_of(const Smoothness<1>&, const Mask<Rational>&, int);
template std::string fault_of(const Smoothness<2>&, const Mask2<Rational>&, int);
template std::string fault_of(const HoelderBounds<1>&, const Mask<Rational>&, int);
template std::string fault_of(const HoelderBounds<2>&, const Mask2<Rational>&, int);

}  // namespace batten
