// SPDX-License-Identifier: MIT
#include <batten/bases/box_spline.h>
#include <batten/bases/mask_text.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Q = Rational;
using M2 = Mask2<Rational>;

const Directions linear = {{1, 0}, {0, 1}, {1, 1}};
const Directions zwart_powell = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}};
const Directions quartic = {{1, 0}, {1, 0}, {0, 1}, {0, 1}, {1, 1}, {1, 1}};

TEST(BoxSpline, has_the_printed_masks) {
  // [Warren & Weimer 2001, sec. 2.2.4]
  EXPECT_EQ(box_mask({{1, 0}, {0, 1}}), parse_mask2("1,1;1,1"));
  EXPECT_EQ(box_mask(linear), parse_mask2("1/2,1/2,0;1/2,1,1/2;0,1/2,1/2"));
  EXPECT_EQ(box_mask(zwart_powell), parse_mask2("0,1/4,1/4,0;1/4,1/2,1/2,1/4;1/4,1/2,1/2,1/4;0,1/4,1/4,0", {-1, 0}));
  EXPECT_EQ(Q(16) * box_mask(quartic), parse_mask2("1,2,1,0,0;2,6,6,2,0;1,6,10,6,1;0,2,6,6,2;0,0,1,2,1"));
}

TEST(BoxSpline, has_the_printed_difference_masks) {
  // [Warren & Weimer 2001, sec. 2.3.3]
  EXPECT_EQ(box_difference_mask(linear), parse_mask2("1,-1,0;-1,0,1;0,1,-1"));
  EXPECT_EQ(box_difference_mask(zwart_powell), parse_mask2("0,1,-1,0;-1,0,0,1;1,0,0,-1;0,-1,1,0", {-1, 0}));
  EXPECT_EQ(box_difference_mask(quartic), parse_mask2("1,-2,1,0,0;-2,2,2,-2,0;1,2,-6,2,1;0,-2,2,2,-2;0,0,1,-2,1"));
}

TEST(BoxSpline, obeys_the_two_scale_law_of_differences) {
  // d_k s = 4 d_{k-1}[x^2, y^2], d_k = ∏ 2^k (1 - x^a y^b) [Warren & Weimer 2001, sec. 4.2], here k = 1
  for (const auto& directions : {linear, zwart_powell, quartic}) {
    const auto d = box_difference_mask(directions);
    EXPECT_EQ(Q(1 << directions.size()) * d * box_mask(directions), Q(4) * upsampled(d, 2));
  }
}

TEST(BoxSpline, rules_of_the_quartic_are_those_of_regular_loop_subdivision) {
  const auto s = box_mask(quartic);
  EXPECT_EQ(Q(16) * coset(s, {0, 0}), parse_mask2("1,1,0;1,10,1;0,1,1"));
  EXPECT_EQ(Q(8) * coset(s, {1, 0}), parse_mask2("1,0;3,3;0,1"));
}

TEST(BoxSpline, by_repeated_averaging_is_the_same_scheme) {
  const M2 p({-1, 2}, {3, 2}, {1, 3, 2, Q(5, 3), 6, -1});
  for (const auto& directions : {linear, zwart_powell, quartic})
    EXPECT_EQ(box_averaged(p, directions), box_mask(directions) * upsampled(p, 2));
}

TEST(BoxSpline, continuity_counts_the_directions_that_are_not_parallel) {
  EXPECT_EQ(box_continuity({{1, 0}, {0, 1}}), -1);
  EXPECT_EQ(box_continuity(linear), 0);
  EXPECT_EQ(box_continuity({{1, 0}, {0, 1}, {1, 1}, {1, 1}}), 0);
  EXPECT_EQ(box_continuity(zwart_powell), 1);
  EXPECT_EQ(box_continuity(quartic), 2);
  EXPECT_EQ(box_continuity({{1, 0}, {-2, 0}, {0, 1}}), -1);
}

TEST(BoxSpline, support_is_a_zonogon) {
  EXPECT_EQ(zonogon({{1, 0}, {0, 1}}), (std::vector<Index<2>>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ(zonogon(linear), (std::vector<Index<2>>{{0, 0}, {1, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 1}}));
  EXPECT_EQ(zonogon(zwart_powell),
            (std::vector<Index<2>>{{0, 0}, {1, 0}, {2, 1}, {2, 2}, {1, 3}, {0, 3}, {-1, 2}, {-1, 1}}));
  EXPECT_EQ(zonogon(quartic), (std::vector<Index<2>>{{0, 0}, {2, 0}, {4, 2}, {4, 4}, {2, 4}, {0, 2}}));
  EXPECT_EQ(zonogon({{1, 0}, {0, -1}}).front(), (Index<2>{0, -1}));
}

TEST(BoxSpline, translates_depend_when_a_basis_has_a_larger_determinant) {
  EXPECT_TRUE(has_independent_translates(linear));
  EXPECT_TRUE(has_independent_translates(quartic));
  EXPECT_FALSE(has_independent_translates(zwart_powell));
  // p_0[i, j] = (-1)^(i + j) gives the zero function [Warren & Weimer 2001, sec. 2.2.4]
  for (const auto& [x, y] : {std::pair{Q(1, 3), Q(2, 7)}, {Q(1, 2), Q(1, 2)}, {Q(0), Q(1, 5)}}) {
    Q sum = 0;
    for (int i = -4; i <= 4; ++i)
      for (int j = -4; j <= 4; ++j) sum += ((i + j) % 2 == 0 ? 1 : -1) * box_spline_value(zwart_powell, x - i, y - j);
    EXPECT_EQ(sum, 0);
  }
}

TEST(BoxSpline, that_does_not_span_is_refused) {
  EXPECT_THAT(
      [] {
        return box_scheme({{1, 0}, {2, 0}});
      },
      ThrowsMessage<InvalidInput>("box_scheme: the directions must span the plane, found '1,0;2,0'"));
  EXPECT_THROW(box_mask({}), InvalidInput);
  EXPECT_THAT(
      [] {
        return box_mask({{1, 0}, {0, 0}, {0, 1}});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("must not be 0,0, found '1,0;0,0;0,1'")));
  EXPECT_THROW(box_mask(Directions(25, {1, 0})), InvalidInput);
  EXPECT_THROW(box_spline_value({{1, 0}}, Q(0), Q(0)), InvalidInput);
}

TEST(BoxSpline, whose_directions_do_not_span_modulo_two_is_not_affine_invariant) {
  EXPECT_NO_THROW(require_affine_invariance(box_scheme(zwart_powell)));
  EXPECT_THAT(
      [] {
        require_affine_invariance(box_scheme({{2, 0}, {0, 1}}));
      },
      ThrowsMessage<InvalidInput>(HasSubstr("coset (0, 0) of box '2,0;0,1' sums to 2")));
}

}  // namespace
}  // namespace batten
