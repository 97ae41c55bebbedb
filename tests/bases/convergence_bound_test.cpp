// SPDX-License-Identifier: MIT
#include <batten/bases/convergence_bound.h>
#include <batten/domains/errors.h>

#include "../support/known_masks.h"
#include <gtest/gtest.h>

#include <algorithm>

namespace batten {
namespace {

using namespace test;
using Q = Rational;

TEST(GeometricTail, is_the_source_s) {
  EXPECT_EQ(geometric_tail(2, Q(1, 2), 3), Q(1, 2));
  EXPECT_THROW(geometric_tail(1, 1, 0), InvalidInput);
  EXPECT_THROW(geometric_tail(1, Q(1, 2), -1), InvalidInput);
}

TEST(ConvergenceBound, of_the_four_point_scheme_is_a_third_of_five_eighths_to_the_k) {
  const auto bound = convergence_bound(custom_scheme<1>(four_point_mask(Q(1, 16))));
  EXPECT_EQ(bound.deviation, Q(1, 8));
  EXPECT_EQ(bound.factor(0), Q(1, 3));
  EXPECT_EQ(bound.factor(2), Q(1, 3) * Q(25, 64));
}

TEST(ConvergenceBound, of_linear_interpolation_is_zero) {
  EXPECT_EQ(convergence_bound(custom_scheme<1>(parse_mask("1/2,1,1/2", -1))).factor(0), 0);
  EXPECT_EQ(convergence_bound(custom_scheme<1>(parse_mask("1/3,2/3,1,2/3,1/3", -2), 3)).factor(0), 0);
}

TEST(ConvergenceBound, holds_for_the_limit_of_a_step) {
  // p_0 = δ, ‖D p_0‖ = 1: |φ(x) - hat(x)| at x = 1/2, 3/2 and 1/4 [φ(1/2) = 9/16, φ(3/2) = -1/16, φ(1/4) = 27/32]
  const Q bound = convergence_bound(custom_scheme<1>(four_point_mask(Q(1, 16)))).factor(0);
  EXPECT_LE(abs(Q(9, 16) - Q(1, 2)), bound);
  EXPECT_LE(Q(1, 16), bound);
  EXPECT_LE(abs(Q(27, 32) - Q(3, 4)), bound);
}

TEST(ConvergenceBound, uses_powers_where_one_round_does_not_shrink) {
  // w = 1/4: ‖T‖ = 1, ‖T²‖ = 3/4
  const auto bound = convergence_bound(custom_scheme<1>(four_point_mask(Q(1, 4))));
  EXPECT_EQ(bound.norms, (std::vector<Q>{1, 1, Q(3, 4)}));
  EXPECT_EQ(bound.factor(0), bound.deviation * 8);
  EXPECT_EQ(bound.factor(3), bound.deviation * 6);
}

TEST(ConvergenceBound, of_surfaces_starts_from_bilinear_ones) {
  const auto bound = convergence_bound(custom_scheme<2>(butterfly_mask()));
  EXPECT_EQ(bound.norms.back(), Q(7, 8));
  EXPECT_GT(bound.deviation, 0);
  const auto bilinear = tensor_product(parse_mask("1/2,1,1/2", -1), parse_mask("1/2,1,1/2", -1));
  EXPECT_EQ(convergence_bound(custom_scheme<2>(bilinear)).deviation, 0);
}

TEST(ConvergenceBound, needs_convergence) {
  EXPECT_THROW(convergence_bound(custom_scheme<1>(bspline_mask(1))), SolverError);
  EXPECT_THROW(convergence_bound(custom_scheme<1>(parse_mask("1/2,3/4,3/4"))), InvalidInput);
}

}  // namespace
}  // namespace batten
