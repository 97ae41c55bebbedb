// SPDX-License-Identifier: MIT
#include <batten/bases/mask_division.h>
#include <batten/bases/sum_rules.h>
#include <batten/domains/errors.h>

#include "../support/known_masks.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace batten {
namespace {

using namespace test;
using Q = Rational;

TEST(SumRules, of_a_bspline_have_its_order) {
  for (int m = 1; m <= 8; ++m) EXPECT_EQ(sum_rule_order(bspline_mask(m)), m);
}

TEST(SumRules, agree_with_divisibility_by_the_smoothing_factor) {
  // [Warren & Weimer 2001, th. 3.7]
  const Mask<Q> two(0, {1, 1}), three(0, {1, 1, 1});
  for (const Q& w : {Q(1, 16), Q(1, 32), Q(1, 10)})
    EXPECT_EQ(sum_rule_order(four_point_mask(w)), multiplicity(two, four_point_mask(w)));
  for (const Q& theta : {Q(1, 96), Q(1, 20), Q(3, 256)})
    EXPECT_EQ(sum_rule_order(six_point_mask(theta)), multiplicity(two, six_point_mask(theta)));
  EXPECT_EQ(sum_rule_order(ternary_four_point_mask(Q(1, 11)), 3),
            multiplicity(three, ternary_four_point_mask(Q(1, 11))));
}

TEST(SumRules, of_named_schemes_have_the_orders_of_the_source) {
  EXPECT_EQ(sum_rule_order(four_point_mask(Q(1, 16))), 4);  // (1+x)^4 (1-4x+x²)
  EXPECT_EQ(sum_rule_order(four_point_mask(Q(1, 32))), 2);  // (1+x)^3 divides iff w = 1/16
  EXPECT_EQ(sum_rule_order(deslauriers_dubuc_mask()), 6);
  EXPECT_EQ(sum_rule_order(parse_mask("2,0,-5,0,13,20,13,0,-5,0,2") * Q(1, 20)), 2);  // six-point A: factor (1+x)²
  EXPECT_EQ(sum_rule_order(six_point_mask(Q(1, 20))), 4);                             // six-point B: (1+x)^4
  EXPECT_EQ(sum_rule_order(Mask2<Q>(parse_mask2("1,1;1,1"))), 1);
  EXPECT_EQ(sum_rule_order(three_direction_linear_mask()), 2);
  EXPECT_EQ(sum_rule_order(zwart_powell_mask()), 2);
  EXPECT_EQ(sum_rule_order(three_direction_quartic_mask()), 4);
  EXPECT_EQ(sum_rule_order(butterfly_mask()), 4);
  EXPECT_EQ(sum_rule_order(quad_interpolatory_mask()), 4);  // "order three" in the book is a slip
}

TEST(SumRules, are_zero_for_a_mask_that_does_not_keep_constants) {
  EXPECT_EQ(sum_rule_order(parse_mask("1/2,3/4,3/4")), 0);
  EXPECT_THROW(sum_rule_order(Mask<Q>()), InvalidInput);
  EXPECT_THROW(sum_rule_order(bspline_mask(2), 4), InvalidInput);
}

TEST(PolynomialDegrees, of_bsplines_are_order_minus_one_generated_and_one_reproduced) {
  for (int m = 2; m <= 8; ++m) {
    const auto degrees = polynomial_degrees(bspline_mask(m));
    EXPECT_EQ(degrees.generated, m - 1);
    EXPECT_EQ(degrees.reproduced, 1);
    EXPECT_EQ(degrees.shift[0], Q(m, 2));  // the middle of the support
  }
  EXPECT_EQ(polynomial_degrees(bspline_mask(1)).reproduced, 0);
}

TEST(PolynomialDegrees, do_not_depend_on_where_the_mask_is_put) {
  const auto dual = polynomial_degrees(centred(bspline_mask(3)));
  EXPECT_EQ(dual.shift[0], 0);
  EXPECT_EQ(dual.reproduced, 1);
  EXPECT_EQ(polynomial_degrees(shifted(four_point_mask(Q(1, 16)), {5})).reproduced, 3);
}

TEST(PolynomialDegrees, of_interpolatory_schemes_are_both_the_same) {
  EXPECT_EQ(polynomial_degrees(four_point_mask(Q(1, 16))).reproduced, 3);
  EXPECT_EQ(polynomial_degrees(four_point_mask(Q(1, 10))).reproduced, 1);
  EXPECT_EQ(polynomial_degrees(deslauriers_dubuc_mask()).reproduced, 5);
  EXPECT_EQ(polynomial_degrees(six_point_mask(Q(1, 96))).reproduced, 3);
  EXPECT_EQ(polynomial_degrees(ternary_four_point_mask(Q(1, 11)), 3).reproduced, 2);
  EXPECT_EQ(polynomial_degrees(butterfly_mask()).reproduced, 3);
  EXPECT_EQ(polynomial_degrees(quad_interpolatory_mask()).reproduced, 3);
}

TEST(PolynomialDegrees, of_box_splines_are_linear_reproduction_about_the_centre) {
  const auto quartic = polynomial_degrees(three_direction_quartic_mask());
  EXPECT_EQ(quartic.generated, 3);
  EXPECT_EQ(quartic.reproduced, 1);
  EXPECT_EQ(quartic.shift[0], 2);
  EXPECT_EQ(quartic.shift[1], 2);
  EXPECT_EQ(polynomial_degrees(zwart_powell_mask()).shift[1], Q(3, 2));
}

}  // namespace
}  // namespace batten
