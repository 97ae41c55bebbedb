// SPDX-License-Identifier: MIT
#include <batten/bases/certificate_check.h>
#include <batten/bases/smoothness.h>
#include <batten/domains/errors.h>

#include "../support/known_masks.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace batten {
namespace {

using namespace test;
using testing::HasSubstr;
using Q = Rational;

/// The proved smoothness, after an independent check that it is proved, and that no more is possible.
template <int D>
int exact_continuity(const LaurentPolynomial<Q, D>& s, int arity = 2) {
  const auto verdict = smoothness(SubdivisionScheme<D>("test", s, arity));
  EXPECT_TRUE(verdict.is_decided()) << explanation(verdict, arity);
  EXPECT_EQ(fault_of(verdict, s, arity), "");
  return verdict.continuity;
}

TEST(Smoothness, of_the_bspline_of_order_m_is_m_minus_2) {
  for (int m = 1; m <= 8; ++m) EXPECT_EQ(exact_continuity(bspline_mask(m)), m - 2);
}

TEST(Smoothness, does_not_depend_on_where_the_mask_is_put) {
  EXPECT_EQ(exact_continuity(centred(bspline_mask(3))), 1);
  EXPECT_EQ(exact_continuity(shifted(bspline_mask(4), {-7})), 2);
  EXPECT_EQ(exact_continuity(shifted(power(Mask<Q>(0, {1, 1, 1}), 3) * Q(1, 9), {1}), 3), 1);
}

TEST(Smoothness, of_interpolatory_schemes_is_the_literature_s) {
  EXPECT_EQ(exact_continuity(four_point_mask(Q(1, 16))), 1);
  EXPECT_EQ(exact_continuity(four_point_mask(Q(1, 32))), 1);
  EXPECT_EQ(exact_continuity(four_point_mask(Q(1, 8))), 1);  // still
  EXPECT_EQ(exact_continuity(deslauriers_dubuc_mask()), 2);
}

TEST(Smoothness, of_six_point_schemes_is_c2_for_kersey_s_and_c1_for_the_pups_filters) {
  EXPECT_EQ(exact_continuity(six_point_mask(Q(1, 96))), 2);
  EXPECT_EQ(exact_continuity(six_point_mask(Q(1, 20))), 1);  // printed as C^2, which its limits at 1/3 refute
  EXPECT_EQ(exact_continuity(parse_mask("2,0,-5,0,13,20,13,0,-5,0,2") * Q(1, 20)), 1);
}

TEST(Smoothness, of_the_ternary_four_point_scheme_is_c2_between_1_15_and_1_9) {
  for (const Q& w : {Q(1, 14), Q(2, 25), Q(1, 11), Q(1, 10)})
    EXPECT_EQ(exact_continuity(ternary_four_point_mask(w), 3), 2) << w;
  for (const Q& w : {Q(1, 15), Q(1, 9)}) EXPECT_EQ(exact_continuity(ternary_four_point_mask(w), 3), 1) << w;
}

TEST(Smoothness, of_corner_cutting_is_c1_for_chaikin_alone) {
  EXPECT_EQ(exact_continuity(parse_mask("1/4,3/4,3/4,1/4")), 1);
  EXPECT_EQ(exact_continuity(parse_mask("1/3,2/3,2/3,1/3")), 0);
}

TEST(Smoothness, of_box_splines_is_the_number_of_directions_less_the_parallel_ones_less_2) {
  EXPECT_EQ(exact_continuity(parse_mask2("1,1;1,1")), -1);
  EXPECT_EQ(exact_continuity(three_direction_linear_mask()), 0);
  EXPECT_EQ(exact_continuity(zwart_powell_mask()), 1);
  EXPECT_EQ(exact_continuity(three_direction_quartic_mask()), 2);
  EXPECT_EQ(exact_continuity(tensor_product(bspline_mask(4), bspline_mask(4))), 2);
  const auto repeated = three_direction_linear_mask() * parse_mask2("1,0;0,1") * Q(1, 2);
  EXPECT_EQ(exact_continuity(repeated), 0);  // directions (1,0), (0,1), (1,1), (1,1)
}

TEST(Smoothness, of_a_box_spline_with_dependent_translates_comes_from_its_directions) {
  // Twice the four directions of Zwart and Powell: C^4, 8 - 2 - 2, while the mask has sum rules of order 4 only.
  const Scheme2::Structure structure{{{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {1, 0}, {0, 1}, {1, 1}, {-1, 1}}, {}};
  const auto s = zwart_powell_mask() * zwart_powell_mask() * Q(1, 4);
  const auto verdict = smoothness(Scheme2("box", s, 2, structure));
  EXPECT_EQ(verdict.continuity, 4);
  EXPECT_TRUE(verdict.is_decided());
  EXPECT_EQ(fault_of(verdict, s), "");
  EXPECT_EQ(fault_of(hoelder_bounds(Scheme2("box", s, 2, structure)), s), "");
  EXPECT_EQ(hoelder_bounds(Scheme2("box", s, 2, structure)).upper, 5);
  auto forged = verdict;
  forged.continuity = 5;
  EXPECT_NE(fault_of(forged, s), "");
  forged = verdict;
  forged.box->directions.pop_back();
  EXPECT_NE(fault_of(forged, s), "");
  // without the directions what differences prove
  const auto typed = smoothness(custom_scheme<2>(s));
  EXPECT_EQ(typed.continuity, 3);
  EXPECT_THAT(explanation(typed, 2), HasSubstr("C^4 undecided: the sum rules are missing"));
}

TEST(Smoothness, of_the_butterfly_and_the_interpolatory_quad_scheme_is_c1) {
  EXPECT_EQ(exact_continuity(butterfly_mask()), 1);
  EXPECT_EQ(exact_continuity(quad_interpolatory_mask()), 1);
}

TEST(Smoothness, of_the_butterfly_on_cylinders_is_the_four_point_scheme_s) {
  // s[x, 1]/2 is the four-point mask
  const auto s = butterfly_mask();
  Mask<Q> rows;
  for (int y = -3; y <= 3; ++y)
    for (int x = -3; x <= 3; ++x) rows += Mask<Q>::monomial({x}, s[{x, y}]);
  EXPECT_EQ(rows * Q(1, 2), four_point_mask(Q(1, 16)));
}

TEST(Smoothness, says_why) {
  const auto text = [](const Mask<Q>& s) { return explanation(smoothness(custom_scheme<1>(s)), 2); };
  EXPECT_THAT(text(four_point_mask(Q(1, 16))), HasSubstr("C^1 because ‖T_2^2‖ = 3/4 < 1; not C^2 because at x = 0"));
  EXPECT_THAT(text(six_point_mask(Q(1, 20))), HasSubstr("not C^2 because at x = 1/3"));
  EXPECT_THAT(text(parse_mask("1/2,3/4,3/4")), HasSubstr("not convergent because coset 0 of the mask sums to 5/4"));
  EXPECT_THAT(text(bspline_mask(1)), HasSubstr("not convergent because at x = 0"));
}

TEST(Smoothness, finds_masks_that_diverge) {
  const auto wild = smoothness(custom_scheme<1>(four_point_mask(Q(2))));
  EXPECT_EQ(wild.continuity, -1);
  EXPECT_TRUE(wild.obstacle.has_value());
  EXPECT_EQ(fault_of(wild, four_point_mask(Q(2))), "");
}

TEST(Smoothness, is_undecided_when_too_few_powers_are_tried) {
  const auto verdict = smoothness(custom_scheme<1>(four_point_mask(Q(1, 16))), {.largest_power = 1});
  EXPECT_EQ(verdict.continuity, 0);
  EXPECT_FALSE(verdict.is_decided());
  EXPECT_THAT(explanation(verdict, 2), HasSubstr("C^1 undecided up to n = 1"));
}

TEST(Smoothness, needs_a_rational_mask) {
  EXPECT_THROW(smoothness(Scheme("real", Mask<double>(0, {0.3, 1, 0.7}))), InvalidInput);
}

}  // namespace
}  // namespace batten
