// SPDX-License-Identifier: MIT
#include <batten/bases/flow_masks.h>
#include <batten/bases/polyharmonic_residual.h>
#include <batten/bases/quotient_coefficients.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <array>
#include <string>
#include <type_traits>

namespace batten {
namespace {

template <Coefficient T>
Mask2<T> as(const Mask2<Rational>& mask) {
  if constexpr (std::is_same_v<T, double>)
    return to_double(mask);
  else
    return mask;
}

/// [numerator of s11, denominator] of a flow; that of s21 has -d[x] in place of d[y].
struct FlowQuotient {
  Mask2<Rational> numerator, denominator;
};

FlowQuotient flow_quotient(Flow flow, const Mask2<Rational>& difference) {
  const auto l = five_point_laplacian(), source = difference * staggered_difference(1, 2);
  if (flow == Flow::Perfect) return {Rational(2) * source, l};
  return {Rational(1) / 2 * source * upsampled(l, 2), l * l};
}

/// The indices within |exponent| <= size / 2 of masks with these half powers.
IndexBox<2> index_box(int size, const Index<2>& half) {
  const int n = (size - 1) / 2;
  return {{-n - half[0], -n - half[1]}, {n, n}};
}

template <class Function>
Mask2<double> tabulated(const IndexBox<2>& box, const Index<2>& half, Function&& coefficient) {
  std::vector<double> values;
  for (const Index<2>& i : indices_of<2>(box)) values.push_back(coefficient(i));
  return {box.first, size_of<2>(box), std::move(values), half};
}

std::size_t parity(int i) { return static_cast<std::size_t>(i & 1); }

}  // namespace

FlowMasks<double> to_double(const FlowMasks<Rational>& masks) { return {to_double(masks.s11), to_double(masks.s21)}; }

Mask2<Rational> staggered_difference(int axis, int n) {
  const int half = n & 1;
  std::vector<Rational> coefficients(static_cast<std::size_t>(n) + 1);
  coefficients.front() = 1;
  coefficients.back() = -1;
  const Mask<Rational> d(-(n + half) / 2, std::move(coefficients), half), one = Mask<Rational>::constant(1);
  return axis == 0 ? tensor_product(d, one) : tensor_product(one, d);
}

Mask2<Rational> flux_mask() {
  const Mask<Rational> pair(-1, {1, 1}, 1);
  return Rational(1) / 2 * tensor_product(pair, pair);
}

template <Coefficient T>
FlowResiduals<T> flow_residuals(Flow flow, FlowKind kind, const FlowMasks<T>& masks) {
  const auto dx = as<T>(staggered_difference(0)), dy = as<T>(staggered_difference(1));
  const auto dy2 = staggered_difference(1, 2), l = five_point_laplacian();
  FlowResiduals<T> r{dx * masks.s11 + dy * masks.s21, dy * masks.s11 - dx * masks.s21};
  if (kind == FlowKind::Commuting) r.divergence -= as<T>(flux_mask() * staggered_difference(0, 2));
  if (flow == Flow::Perfect)
    r.rotation -= as<T>(Rational(2) * dy2);
  else
    r.rotation = as<T>(l) * r.rotation - as<T>(Rational(1) / 2 * upsampled(l, 2) * dy2);
  return r;
}

template <Coefficient T>
T flow_norm(const Mask2<T>& residual) {
  using std::abs;
  std::array<std::array<T, 2>, 2> sums{};
  for (const Index<2>& i : indices_of<2>({residual.first(), residual.last()}))
    sums[parity(i[0])][parity(i[1])] += abs(residual[i]);
  // At (a, b) meet u at (2i, 2j+1), so index (a, b-1), and v at (2i+1, 2j), of the mirrored residual index (b, a-1).
  T largest = 0;
  for (std::size_t a : {0, 1})
    for (std::size_t b : {0, 1}) largest = std::max(largest, T(sums[a][1 - b] + sums[b][1 - a]));
  return largest;
}

PiNumber perfect_s11(LatticeGreen& green, int i, int j) {  // 2 (y^(-3/2) - y^(-1/2) - y^(1/2) + y^(3/2)) G
  return Rational(2) * (green(i, j + 2) - green(i, j + 1) - green(i, j) + green(i, j - 1));
}

PiNumber perfect_s21(LatticeGreen& green, int i, int j) {  // -2 (x^(-1/2) - x^(1/2)) (1/y - y) G
  return Rational(-2) * (green(i + 1, j + 1) - green(i, j + 1) - green(i + 1, j - 1) + green(i, j - 1));
}

FlowMasks<double> truncated_flow_masks(Flow flow, int size) {
  require_flow_size("truncated_flow_masks", size);
  const Index<2> half11{0, 1}, half21{1, 0};
  const auto box11 = index_box(size, half11), box21 = index_box(size, half21);
  if (flow == Flow::Perfect) {
    LatticeGreen green;
    return {tabulated(box11, half11, [&](const Index<2>& i) { return to_double(perfect_s11(green, i[0], i[1])); }),
            tabulated(box21, half21, [&](const Index<2>& i) { return to_double(perfect_s21(green, i[0], i[1])); })};
  }
  const auto q11 = flow_quotient(flow, staggered_difference(1)), q21 = flow_quotient(flow, -staggered_difference(0));
  return {quotient_coefficients(q11.numerator, q11.denominator, box11),
          quotient_coefficients(q21.numerator, q21.denominator, box21)};
}

Mask2<double> exact_flow_rounds(Flow flow, int k, const IndexBox<2>& box) {
  if (k < 1) throw InvalidInput("exact_flow_rounds: k must be at least 1, found " + std::to_string(k));
  const int n = 1 << k;
  const auto l = five_point_laplacian(), source = staggered_difference(1) * staggered_difference(1, n);
  if (flow == Flow::Perfect) return quotient_coefficients(Rational(n) * source, l, box);
  return quotient_coefficients(Rational(1) / n * source * upsampled(l, n), l * l, box);
}

void require_flow_size(const char* function, int size) {
  if (size % 2 == 0 || size < 3)
    throw InvalidInput(std::string(function) + ": the size must be odd and at least 3, found " + std::to_string(size));
}

template FlowResiduals<Rational> flow_residuals(Flow, FlowKind, const FlowMasks<Rational>&);
template FlowResiduals<double> flow_residuals(Flow, FlowKind, const FlowMasks<double>&);
template Rational flow_norm(const Mask2<Rational>&);
template double flow_norm(const Mask2<double>&);

}  // namespace batten
