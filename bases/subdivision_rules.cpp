// SPDX-License-Identifier: MIT
#include <batten/bases/index_box.h>
#include <batten/bases/subdivision_rules.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <limits>
#include <string>

// The kernels are compiled for the instruction sets of the x86-64 levels and chosen at start; other processors get the
// plain one.

namespace batten {
namespace {

int residue(int e, int arity) { return static_cast<int>(e - arity * floor_quotient(e, arity)); }

// g++ 12 otherwise loads an old point once for each new point that it goes into, and most of these loads straddle two
// lines of the cache: adding a zero that it does not know, without effect on the value, keeps the point in a register.
volatile const double unknown_minus_zero = -0.;

constexpr int longest_pass = 6;  // old points read at once: their weights stay in registers

template <int arity, int width, bool adds>
[[gnu::always_inline]] inline void refine_pass(const double* weights, std::ptrdiff_t stride, const double* in,
                                               std::ptrdiff_t groups, double* out) {
  double w[arity][width];
  for (int r = 0; r < arity; ++r)
    for (int q = 0; q < width; ++q) w[r][q] = weights[q + stride * r];
  const double minus_zero = unknown_minus_zero;
  const double* __restrict old = in;
  double* __restrict fine = out;
#pragma omp simd
  for (std::ptrdiff_t g = 0; g < groups; ++g) {
    double sum0 = adds ? fine[arity * g] : 0, sum1 = adds ? fine[arity * g + 1] : 0;
    double sum2 = adds && arity > 2 ? fine[arity * g + arity - 1] : 0;
    for (int q = 0; q < width; ++q) {
      const double value = old[g + q] + minus_zero;
      sum0 += w[0][q] * value;
      sum1 += w[1][q] * value;
      if constexpr (arity > 2) sum2 += w[2][q] * value;
    }
    fine[arity * g] = sum0;
    fine[arity * g + 1] = sum1;
    if constexpr (arity > 2) fine[arity * g + 2] = sum2;
  }
}

template <int arity, bool adds>
[[gnu::always_inline]] inline void refine_pass(int width, const double* weights, std::ptrdiff_t stride,
                                               const double* in, std::ptrdiff_t groups, double* out) {
  switch (width) {
    case 1:
      return refine_pass<arity, 1, adds>(weights, stride, in, groups, out);
    case 2:
      return refine_pass<arity, 2, adds>(weights, stride, in, groups, out);
    case 3:
      return refine_pass<arity, 3, adds>(weights, stride, in, groups, out);
    case 4:
      return refine_pass<arity, 4, adds>(weights, stride, in, groups, out);
    case 5:
      return refine_pass<arity, 5, adds>(weights, stride, in, groups, out);
    default:
      return refine_pass<arity, longest_pass, adds>(weights, stride, in, groups, out);
  }
}

template <int arity>
[[gnu::always_inline]] inline void refine_all(const AxisRules& rules, const double* weights, const double* in,
                                              std::ptrdiff_t groups, double* out) {
  for (int q = 0; q < rules.width; q += longest_pass) {
    const int width = std::min(rules.width - q, longest_pass);
    if (q == 0)
      refine_pass<arity, false>(width, weights, rules.width, in, groups, out);
    else
      refine_pass<arity, true>(width, weights + q, rules.width, in + q, groups, out);
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void refine_by_two(const AxisRules& rules, const double* weights, const double* in, std::ptrdiff_t groups,
                   double* out) {
  refine_all<2>(rules, weights, in, groups, out);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void refine_by_three(const AxisRules& rules, const double* weights, const double* in, std::ptrdiff_t groups,
                     double* out) {
  refine_all<3>(rules, weights, in, groups, out);
}

}  // namespace

std::ptrdiff_t place_of(std::ptrdiff_t i, std::ptrdiff_t n, Ends ends) {
  const auto modulo = [](std::ptrdiff_t a, std::ptrdiff_t period) { return (a % period + period) % period; };
  if (ends == Ends::Periodic) return modulo(i, n);
  if (ends == Ends::Reflect) {
    const std::ptrdiff_t last = n - 1;
    if (last == 0) return 0;
    const std::ptrdiff_t turned = modulo(i, 2 * last);
    return turned <= last ? turned : 2 * last - turned;
  }
  return i >= 0 && i < n ? i : -1;
}

template <int D>
bool is_even(const LaurentPolynomial<double, D>& mask, std::size_t axis) {
  if (mask.half()[axis] != 0 || mask.first()[axis] != -mask.last()[axis]) return false;
  const Index<D> first = mask.first(), size = mask.size();
  for (std::size_t k = 0; k < mask.coefficients().size(); ++k) {
    Index<D> at = first;
    at[0] += static_cast<int>(k) % size[0];
    if constexpr (D == 2) at[1] += static_cast<int>(k) / size[0];
    const double c = mask.coefficients()[k];
    at[axis] = -at[axis];
    if (mask[at] != c) return false;
  }
  return true;
}

template <int D>
void require_ends(const char* function, const LaurentPolynomial<double, D>& mask, std::size_t axis, Ends ends) {
  if (ends == Ends::Reflect && !is_even(mask, axis))
    throw InvalidInput(std::string(function) + ": reflection at the ends needs a mask that is symmetric about 0 in " +
                       (axis == 0 ? "x" : "y") + ", found one that is not");
}

IndexRange AxisRules::groups_of(const IndexRange& fine) const {
  return {floor_quotient(fine.begin, arity), floor_quotient(fine.end - 1, arity) + 1};
}

IndexRange AxisRules::window_of(const IndexRange& groups) const {
  return {groups.begin - reach, groups.end - reach + width - 1};
}

IndexRange AxisRules::refined(const IndexRange& old, Ends ends) const {
  if (ends == Ends::Periodic) return {arity * old.begin, arity * old.end};
  if (ends == Ends::Reflect) return {arity * old.begin, arity * (old.end - 1) + 1};
  if (ends == Ends::Zero) return {arity * old.begin + exponents.begin, arity * (old.end - 1) + exponents.end};
  // New point arity j + e uses old point j where e has a coefficient: the last one that uses old.begin - 1 and the
  // first one that uses old.end are unknown.
  IndexRange known{std::numeric_limits<std::ptrdiff_t>::min(), std::numeric_limits<std::ptrdiff_t>::max()};
  for (std::size_t r = 0; r < static_cast<std::size_t>(arity); ++r) {
    if (highest[r] < lowest[r]) continue;
    known.begin = std::max(known.begin, arity * (old.begin - 1) + highest[r] + 1);
    known.end = std::min(known.end, arity * old.end + lowest[r]);
  }
  return {known.begin, std::max(known.begin, known.end)};
}

template <int D>
AxisRules axis_rules(const LaurentPolynomial<double, D>& mask, std::size_t axis, int arity) {
  AxisRules rules;
  rules.arity = arity;
  const int first = mask.first()[axis], last = mask.last()[axis];
  rules.exponents = {first, last + 1};
  rules.reach = static_cast<int>(floor_quotient(last, arity));
  rules.width = rules.reach - static_cast<int>(floor_quotient(first, arity)) + 1;
  rules.lowest.fill(last + 1);
  rules.highest.fill(first - 1);
  const auto row = static_cast<std::size_t>(mask.size()[0]);
  for (std::size_t k = 0; k < mask.coefficients().size(); ++k) {
    if (mask.coefficients()[k] == 0) continue;
    const int e = first + static_cast<int>(axis == 0 ? k % row : k / row);
    const auto r = static_cast<std::size_t>(residue(e, arity));
    rules.lowest[r] = std::min(rules.lowest[r], e);
    rules.highest[r] = std::max(rules.highest[r], e);
  }
  return rules;
}

std::vector<std::vector<double>> group_weights(const Mask<double>& mask, const AxisRules& x) {
  std::vector<double> weights;
  for (int r = 0; r < x.arity; ++r)
    for (int q = 0; q < x.width; ++q) weights.push_back(mask[r + x.arity * (x.reach - q)]);
  return {std::move(weights)};
}

std::vector<std::vector<double>> group_weights(const Mask2<double>& mask, const AxisRules& x, const AxisRules& y) {
  std::vector<std::vector<double>> sets;
  for (int ry = 0; ry < y.arity; ++ry)
    for (int qy = 0; qy < y.width; ++qy) {
      auto& weights = sets.emplace_back();
      const int ey = ry + y.arity * (y.reach - qy);
      for (int r = 0; r < x.arity; ++r)
        for (int q = 0; q < x.width; ++q) weights.push_back(mask[{r + x.arity * (x.reach - q), ey}]);
    }
  return sets;
}

void refine_groups_into(const AxisRules& rules, const double* weights, const double* in, std::ptrdiff_t groups,
                        double* out) {
  if (rules.arity == 2)
    refine_by_two(rules, weights, in, groups, out);
  else
    refine_by_three(rules, weights, in, groups, out);
}

template bool is_even(const Mask<double>&, std::size_t);
template bool is_even(const Mask2<double>&, std::size_t);
template void require_ends(const char*, const Mask<double>&, std::size_t, Ends);
template void require_ends(const char*, const Mask2<double>&, std::size_t, Ends);
template AxisRules axis_rules(const Mask<double>&, std::size_t, int);
template AxisRules axis_rules(const Mask2<double>&, std::size_t, int);

}  // namespace batten
