// SPDX-License-Identifier: MIT
#include <batten/bases/asymptotic_comparison.h>
#include <batten/bases/certificate_check.h>
#include <batten/domains/errors.h>

#include "../support/known_masks.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

using namespace test;
using testing::HasSubstr;

TEST(AsymptoticComparison, proves_the_tension_scheme_c2) {
  for (double sigma : {-0.9, 0., std::cos(0.7), 1., 1.5, 20.}) {
    const auto found = asymptotic_smoothness(tension_problem(sigma), 40);
    EXPECT_EQ(found.continuity, 2) << sigma;
    EXPECT_TRUE(found.proved_bound);
    EXPECT_LE(found.largest_ratio, 1);
    EXPECT_EQ(fault_of(found.limit_verdict, parse_mask("1/2,1,1/2")), "");
  }
}

TEST(AsymptoticComparison, tension_ratio_lies_between_0_and_a_half) {
  double sigma = 0.3;
  for (int k = 1; k <= 12; ++k) {
    const double next = std::sqrt((1 + sigma) / 2), ratio = (1 - next) / (1 - sigma);
    EXPECT_GT(ratio, 0);
    EXPECT_LT(ratio, 0.5);
    EXPECT_NEAR(ratio, 1 / (2 * (1 + next)), 1e-7);  // cancellation: ε / (1 - σ_12)
    sigma = next;
  }
}

TEST(AsymptoticComparison, proves_exponential_bsplines_of_order_m_c_m_minus_2) {
  using Roots = std::vector<std::complex<double>>;
  EXPECT_EQ(asymptotic_smoothness(exponential_spline_problem(Roots{0, 0})).continuity, 0);
  EXPECT_EQ(asymptotic_smoothness(exponential_spline_problem(Roots{1, -2, 3})).continuity, 1);
  EXPECT_EQ(asymptotic_smoothness(exponential_spline_problem(Roots{0, 0, 1, -1})).continuity, 2);
  const auto circle = asymptotic_smoothness(exponential_spline_problem(Roots{{0, 3}, 0, {0, -3}}));
  EXPECT_EQ(circle.continuity, 1);
  EXPECT_LE(circle.largest_ratio, 1);
  EXPECT_EQ(asymptotic_smoothness(exponential_spline_problem(Roots{{0, 50}, {0, 2}, {0, -50}, {0, -2}})).continuity, 2);
}

TEST(AsymptoticComparison, says_what_was_only_observed) {
  auto problem = tension_problem(0.5);
  problem.bound.reason.clear();
  const auto found = asymptotic_smoothness(problem, 12);
  EXPECT_FALSE(found.proved_bound);
  EXPECT_THAT(found.explanation, HasSubstr("C^2 provided that"));
  EXPECT_THAT(found.explanation, HasSubstr("was only observed, on levels 1 to 12"));
}

TEST(AsymptoticComparison, of_the_whole_tension_mask_with_the_same_ratio_gives_less) {
  // alpha = 1/2 is not below 2^-1: without the smoothing factors the comparison proves C^0
  const auto b = tension_problem(0.5);
  AsymptoticProblem whole = b;
  whole.rest = [rest = b.rest](int level) { return rest(level) * Mask<double>(0, {0.25, 0.5, 0.25}); };
  whole.limit = bspline_mask(4);
  whole.smoothing_factors = 0;
  EXPECT_EQ(asymptotic_smoothness(whole).continuity, 0);
}

TEST(AsymptoticComparison, takes_back_a_bound_that_fails) {
  auto problem = tension_problem(0.5);
  problem.bound.alpha = Rational(1, 8);  // the distances go down by a quarter
  const auto found = asymptotic_smoothness(problem);
  EXPECT_EQ(found.continuity, -1);
  EXPECT_GT(found.first_violation, 0);
  EXPECT_THAT(found.explanation, HasSubstr("fails on level"));
}

TEST(AsymptoticComparison, refuses_families_that_are_not_defined) {
  EXPECT_THROW(tension_problem(-1), InvalidInput);
  EXPECT_THROW(exponential_spline_problem({1.}), InvalidInput);
  EXPECT_THROW(exponential_spline_problem({std::complex<double>(0, 1), 2.}), InvalidInput);
}

}  // namespace
}  // namespace batten
