// SPDX-License-Identifier: MIT
#include <batten/bases/flow_masks.h>
#include <batten/bases/mask_values.h>
#include <batten/bases/optimal_flow_masks.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Q = Rational;

TEST(StaggeredDifference, has_the_exponents_of_the_source) {  // x^(-n/2) - x^(n/2)
  EXPECT_EQ(staggered_difference(0), (Mask2<Q>({-1, 0}, {2, 1}, {1, -1}, {1, 0})));
  EXPECT_EQ(staggered_difference(1, 2), (Mask2<Q>({0, -1}, {1, 3}, {1, 0, -1})));
  EXPECT_EQ(staggered_difference(1, 3), (Mask2<Q>({0, -2}, {1, 4}, {1, 0, 0, -1}, {0, 1})));
  const auto dx = staggered_difference(0), dy = staggered_difference(1);
  EXPECT_EQ(dx * dx + dy * dy, (Mask2<Q>({-1, -1}, {3, 3}, {0, 1, 0, 1, -4, 1, 0, 1, 0})));
}

TEST(PerfectFlowMasks, obey_both_laws_exactly) {
  LatticeGreen green;
  for (int j = -4; j <= 4; ++j)
    for (int i = -4; i <= 4; ++i) {
      const PiNumber divergence = perfect_s11(green, i + 1, j) - perfect_s11(green, i, j) +
                                  perfect_s21(green, i, j + 1) - perfect_s21(green, i, j);
      EXPECT_EQ(divergence, PiNumber()) << i << ", " << j;
      const PiNumber rotation = perfect_s11(green, i, j) - perfect_s11(green, i, j - 1) - perfect_s21(green, i, j) +
                                perfect_s21(green, i - 1, j);
      const int source = i != 0 ? 0 : j == -1 ? 2 : j == 1 ? -2 : 0;  // 2 (1/y - y)
      EXPECT_EQ(rotation, (PiNumber{source, 0})) << i << ", " << j;
    }
}

TEST(PerfectFlowMasks, have_their_value_at_the_centre) {
  // 2 (G(0,2) - G(0,1) - G(0,0) + G(0,-1)), G(2,0) = 1 - 2/π
  LatticeGreen green;
  EXPECT_EQ(perfect_s11(green, 0, 0), (PiNumber{2, -4}));
}

TEST(ExactFlowRounds, are_the_masks_after_one) {
  LatticeGreen green;
  const auto perfect = exact_flow_rounds(Flow::Perfect, 1, {{-3, -3}, {3, 3}});
  for (const Index<2>& i : indices_of<2>({{-3, -3}, {3, 3}}))
    EXPECT_NEAR(perfect[i], to_double(perfect_s11(green, i[0], i[1])), 1e-12);
  const auto slow = exact_flow_rounds(Flow::Slow, 1, {{-2, -3}, {2, 2}});
  const auto truncated = truncated_flow_masks(Flow::Slow, 5).s11;
  for (const Index<2>& i : indices_of<2>({{-2, -3}, {2, 2}})) EXPECT_NEAR(slow[i], truncated[i], 1e-12);
  EXPECT_THROW(exact_flow_rounds(Flow::Slow, 0, {{0, 0}, {1, 1}}), InvalidInput);
}

TEST(TruncatedFlowMasks, obey_the_laws_where_nothing_is_missing) {
  for (Flow flow : {Flow::Perfect, Flow::Slow}) {
    const auto r = flow_residuals(flow, FlowKind::Book, truncated_flow_masks(flow, 9));
    for (const Index<2>& i : indices_of<2>({{-2, -2}, {2, 2}})) {
      EXPECT_NEAR(r.divergence[i], 0, 1e-11);
      EXPECT_NEAR(r.rotation[i], 0, 1e-11);
    }
  }
}

/// Every flow and kind.
class OptimalFlowMasksOf : public testing::TestWithParam<std::tuple<Flow, FlowKind>> {
protected:
  Flow flow() const { return std::get<0>(GetParam()); }
  FlowKind kind() const { return std::get<1>(GetParam()); }
  OptimalFlowMasks of_size(int size) const { return optimal_flow_masks(flow(), kind(), size); }
};

INSTANTIATE_TEST_SUITE_P(All, OptimalFlowMasksOf,
                         testing::Combine(testing::Values(Flow::Perfect, Flow::Slow),
                                          testing::Values(FlowKind::Book, FlowKind::Commuting)));

TEST_P(OptimalFlowMasksOf, keep_constants) {
  const auto [masks, divergence, rotation] = of_size(5);
  for (int b : {0, 1})
    for (int a : {0, 1}) {
      EXPECT_EQ(sum(coset(masks.s11, {a, b})), 1);
      EXPECT_EQ(sum(coset(masks.s21, {a, b})), 0);
    }
}

TEST_P(OptimalFlowMasksOf, obey_one_law_exactly) {
  const auto optimal = of_size(5);
  const auto r = flow_residuals(flow(), kind(), optimal.masks);
  EXPECT_EQ(flow_norm(r.divergence), optimal.divergence);
  EXPECT_EQ(flow_norm(r.rotation), optimal.rotation);
  if (kind() == FlowKind::Commuting) {
    EXPECT_TRUE(r.divergence.is_zero()) << r.divergence.size()[0];
    EXPECT_GT(optimal.rotation, 0);
  } else if (flow() == Flow::Perfect) {
    EXPECT_TRUE(r.rotation.is_zero());
    EXPECT_GT(optimal.divergence, 0);
  }
}

TEST_P(OptimalFlowMasksOf, have_the_symmetries_and_the_size) {
  const auto [masks, divergence, rotation] = of_size(7);
  for (const Index<2>& i : indices_of<2>({{-9, -9}, {9, 9}})) {
    EXPECT_EQ(masks.s11[i], masks.s11[(Index<2>{-i[0], i[1]})]);
    EXPECT_EQ(masks.s11[i], masks.s11[(Index<2>{i[0], -i[1] - 1})]);
    EXPECT_EQ(masks.s21[i], -masks.s21[(Index<2>{-i[0] - 1, i[1]})]);
    EXPECT_EQ(masks.s21[i], -masks.s21[(Index<2>{i[0], -i[1]})]);
  }
  EXPECT_EQ(masks.s11.half(), (Index<2>{0, 1}));
  EXPECT_EQ(masks.s21.half(), (Index<2>{1, 0}));
  for (const auto& mask : {masks.s11, masks.s21}) {
    EXPECT_LE(2 * mask.last()[0] + mask.half()[0], 7);
    EXPECT_LE(2 * mask.last()[1] + mask.half()[1], 7);
  }
}

TEST_P(OptimalFlowMasksOf, improve_with_their_size) {
  Rational last = 100;
  for (int size : {5, 7, 9, 11}) {
    const auto optimal = of_size(size);
    const Rational worst = optimal.divergence + optimal.rotation;
    EXPECT_LT(worst, last) << size;
    EXPECT_GT(worst, 0);
    last = worst;
  }
}

/// What is added leaves the exact law and constants alone: s11 + d[x] a, s21 + d[y] a for the law of rotation, s11 +
/// d[y] b, s21 - d[x] b for that of divergence.
TEST_P(OptimalFlowMasksOf, cannot_be_improved) {
  const auto optimal = of_size(5);
  const auto dx = staggered_difference(0), dy = staggered_difference(1);
  std::mt19937 random(5);
  std::uniform_int_distribution<int> digit(-9, 9);
  for (int trial = 0; trial < 20; ++trial) {
    FlowMasks<Q> other = optimal.masks;
    const Q p = Q(digit(random)) / 1000, q = Q(digit(random)) / 1000;
    if (kind() == FlowKind::Commuting) {  // b = (p + q (x + 1/x)) (y - 1/y)
      const auto b = Mask2<Q>({-1, 0}, {3, 1}, {q, p, q}) * Mask2<Q>({0, -1}, {1, 3}, {-1, 0, 1});
      other = {other.s11 + dy * b, other.s21 - dx * b};
    } else {  // a = p (x^(3/2) - x^(-3/2) + x^(1/2) - x^(-1/2)) (y^(1/2) + y^(-1/2)), zero at x = -1
      const auto a = Mask2<Q>({-2, 0}, {4, 1}, {-p, -p, p, p}, {1, 0}) * Mask2<Q>({0, -1}, {1, 2}, {1, 1}, {0, 1});
      other = {other.s11 + dx * a, other.s21 + dy * a};
    }
    const auto r = flow_residuals(flow(), kind(), other);
    EXPECT_GE(flow_norm(r.divergence) + flow_norm(r.rotation), optimal.divergence + optimal.rotation);
  }
}

TEST(OptimalFlowMasks, refuse_sizes_that_are_none) {
  EXPECT_THAT([] { optimal_flow_masks(Flow::Perfect, FlowKind::Book, 6); },
              ThrowsMessage<InvalidInput>(HasSubstr("the size must be odd and at least 3, found 6")));
  EXPECT_THROW(truncated_flow_masks(Flow::Slow, 1), InvalidInput);
}

}  // namespace
}  // namespace batten
