// SPDX-License-Identifier: MIT
#include <batten/bases/scaling_function.h>
#include <batten/bases/scaling_pieces.h>
#include <batten/bases/scaling_values.h>
#include <batten/domains/errors.h>

#include "../support/masks_by_hand.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using namespace test;

std::vector<double> random_numbers(int count, double low, double high) {
  std::mt19937_64 random(11);
  std::vector<double> numbers;
  for (int k = 0; k < count; ++k)
    numbers.push_back(low + (high - low) * std::ldexp(static_cast<double>(random() >> 11), -53));
  return numbers;
}

TEST(ScalingFunction, of_b_splines_is_within_its_bound_of_the_pieces) {
  for (int arity : {2, 3})
    for (int m : {2, 3, 4, 6})
      for (int r = 0; r < m - 1; ++r) {
        const auto scheme = b_spline_by_hand(m, arity);
        const ScalingFunction<1> n(scheme, {r});
        const auto pieces = derivative(*pieces_if_polynomial(scheme), r);
        for (double x : random_numbers(100, -0.5, m + 0.5)) {
          const auto [found, error] = n(x);
          const auto exact = static_cast<double>(value(pieces, Rational(x)));
          ASSERT_LE(std::abs(found - exact), error) << arity << " " << m << " " << r << " " << x;
          ASSERT_LT(error, 1e-10);
        }
      }
}

TEST(ScalingFunction, of_the_four_point_scheme_has_the_values_of_the_reference) {
  const ScalingFunction<1> phi(four_point_by_hand()), slope(four_point_by_hand(), {1});
  EXPECT_NEAR(phi(0.25).value, 27. / 32, phi(0.25).error);
  EXPECT_NEAR(phi(2.25).value, 1. / 256, phi(2.25).error);
  EXPECT_EQ(phi(3.5).value, 0);
  EXPECT_NEAR(slope(-1).value, 2. / 3, slope(-1).error);
  EXPECT_LT(slope(0.3).error, 1e-10);
  EXPECT_TRUE(slope.error_is_proved());
}

TEST(ScalingFunction, at_random_doubles_is_the_exact_value_there) {
  const ScalingFunction<1> phi(four_point_by_hand(), {1});
  const ScalingFunction<2> b(butterfly_by_hand()), bx(butterfly_by_hand(), {1, 0});
  const auto numbers = random_numbers(20, -2.5, 2.5);
  for (std::size_t k = 1; k < numbers.size(); ++k) {
    const double x = numbers[k], y = numbers[k - 1];
    const auto f = phi(x);
    ASSERT_LE(std::abs(f.value - static_cast<double>(value_at(four_point_by_hand(), {Rational(x)}, {1}))), f.error);
    const auto g = b({x, y}), gx = bx({x, y});
    const Coordinates<Q, 2> point = {Rational(x), Rational(y)};
    ASSERT_LE(std::abs(g.value - static_cast<double>(value_at(butterfly_by_hand(), point))), g.error);
    ASSERT_LE(std::abs(gx.value - static_cast<double>(value_at(butterfly_by_hand(), point, {1, 0}))), gx.error);
    ASSERT_LT(gx.error, 1e-8);
  }
}

TEST(ScalingFunction, of_derivatives_that_are_not_differences_is_exact_to_rounding) {
  const auto skew = box_spline_by_hand({{1, 1}, {-1, 1}, {1, 2}, {0, 1}, {0, 1}, {-1, 2}});
  const ScalingFunction<2> dx(skew, {1, 0});
  const auto values = values_at_level(skew, 2, {1, 0});
  for (int i = -5; i <= 8; ++i)
    for (int j = 0; j <= 20; j += 3)
      ASSERT_NEAR(dx({i / 4., j / 4.}).value, static_cast<double>(values[{i, j}]), 1e-15);
}

TEST(ScalingFunction, basis_at_a_point_sums_to_one) {
  const ScalingFunction<2> zp(zwart_powell_by_hand()), zpx(zwart_powell_by_hand(), {1, 0});
  for (double x : random_numbers(20, -100, 100)) {
    const auto basis = zp.at({x, 3 * x + 1}), slopes = zpx.at({x, 3 * x + 1});
    double sum = 0, slope = 0, reproduced = 0;
    for (int j = 0, k = 0; j < basis.size[1]; ++j)
      for (int i = 0; i < basis.size[0]; ++i, ++k) {
        sum += basis.values[static_cast<std::size_t>(k)];
        reproduced += (basis.first[0] + i + 0.5) * basis.values[static_cast<std::size_t>(k)];  // centre (1/2, 3/2)
      }
    for (double v : slopes.values) slope += v;
    const double tolerance = static_cast<double>(basis.values.size()) * 4e-15;
    EXPECT_NEAR(sum, 1, tolerance);
    EXPECT_NEAR(slope, 0, tolerance);
    EXPECT_NEAR(reproduced, x, 101 * tolerance);
  }
}

TEST(ScalingFunction, of_half_integer_masks_is_shifted_exactly) {
  const Scheme chaikin("chaikin", centred(b_spline_by_hand(3).exact_mask()));
  const ScalingFunction<1> n(chaikin);
  EXPECT_EQ(n(0).value, 0.75);
  EXPECT_EQ(n(1).value, 0.125);
  EXPECT_NEAR(n(-1e-20).value, 0.75, n(-1e-20).error);
  EXPECT_NEAR(n(1.5).value, 0, n(1.5).error);
  EXPECT_EQ(value_at(chaikin, {Q(-1, 4)}), Q(3, 4) - Q(1, 16));  // 3/4 - x^2
}

TEST(ScalingFunction, of_bad_input_is_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const ScalingFunction<1> n(b_spline_by_hand(3));
  EXPECT_THAT([&] { return n(nan); }, ThrowsMessage<InvalidInput>(HasSubstr("must be finite")));
  EXPECT_THAT([] { return ScalingFunction<1>(four_point_by_hand(), {2}); },
              ThrowsMessage<InvalidInput>(HasSubstr("four-point is at most C^1: no second derivative")));
  EXPECT_THAT([] { return value_at(four_point_by_hand(), {Q(1, 3)}); },
              ThrowsMessage<InvalidInput>(HasSubstr("times a power of the arity must be integers")));
  EXPECT_EQ(value_at(b_spline_by_hand(2, 3), {Q(1, 9)}), Q(1, 9));
}

}  // namespace
}  // namespace batten
