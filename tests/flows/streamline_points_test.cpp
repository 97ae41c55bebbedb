// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/hierarchy.h>
#include <batten/fem/null_space.h>
#include <batten/flows/streamline_points.h>

#include "../support/message_of.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace batten {
namespace {

using testing::HasSubstr;

const Rectangle region = {Interval(-1, 1, 8), Interval(-1, 1, 8)};

// ψ = a x² + b x y + c y²
FlowField quadratic(double a, double b, double c) {
  const SplineSpace space = finest_space(region, 3);
  std::vector<double> coefficients(space.size());
  QuadraticFunction{{0, 0, 0, a, b, c}, 0, 0, 1}.add_to(space, coefficients);
  return FlowField(Solution(region, 3, std::move(coefficients)));
}

// v = 3 (-y, x)
FlowField rotation() { return quadratic(-1.5, 0, -1.5); }

TEST(StreamlinePoints, of_a_rotation_lie_at_equal_angles) {
  const FlowField field = rotation();
  const Streamline line = StreamlineTracer(field).trace(0.5, 0);
  ASSERT_TRUE(line.closed());
  EXPECT_NEAR(line.length.back(), std::numbers::pi, 1e-8);
  for (const auto parameter : {StreamlineParameter::Length, StreamlineParameter::Time}) {
    const bool is_time = parameter == StreamlineParameter::Time;
    const double angle = 0.1, step = is_time ? angle / 3 : angle * 0.5;
    const Streamline even = with_even_points(field, line, {.parameter = parameter, .step = step});
    ASSERT_EQ(even.x.size(), 64U);  // 62 whole steps of a turn, and both ends
    EXPECT_TRUE(even.closed());
    for (std::size_t k = 0; k < 63; ++k) {
      // Pieces of a hundredth of the side: the cubic errs by (h/r)^4 / 384 of r.
      EXPECT_NEAR(even.x[k], 0.5 * std::cos(angle * static_cast<double>(k)), 1e-8);
      EXPECT_NEAR(even.y[k], 0.5 * std::sin(angle * static_cast<double>(k)), 1e-8);
      EXPECT_NEAR(even.time[k], angle / 3 * static_cast<double>(k), 1e-8);
      EXPECT_NEAR(even.length[k], angle / 2 * static_cast<double>(k), 1e-8);
    }
    EXPECT_EQ(even.x.back(), line.x.back());
    EXPECT_EQ(even.time.back(), line.time.back());
  }
}

TEST(StreamlinePoints, count_from_the_seed_upstream_and_downstream) {
  // v = (x, -y): x = x0 e^t, y = y0 e^-t, from side to side.
  const FlowField field = quadratic(0, 1, 0);
  const Streamline line = StreamlineTracer(field).trace(0.5, 0.5);
  const Streamline even = with_even_points(field, line, {.parameter = StreamlineParameter::Time, .step = 0.125});
  ASSERT_EQ(even.x.size(), 13U);  // log 2 = 5.55 steps each way, the seed and the ends
  for (int k = -5; k <= 5; ++k) {
    const auto i = static_cast<std::size_t>(k + 6);
    EXPECT_NEAR(even.time[i], 0.125 * k, 1e-8);
    EXPECT_NEAR(even.x[i], 0.5 * std::exp(0.125 * k), 1e-8);
    EXPECT_NEAR(even.y[i], 0.5 * std::exp(-0.125 * k), 1e-8);
    EXPECT_EQ(even.length[i] < 0, k < 0);
  }
  EXPECT_EQ(even.y.front(), 1);
  EXPECT_EQ(even.x.back(), 1);
  const double length = line.length.back() - line.length.front();
  const Streamline few = with_even_points(field, line, {.step = length / 1000, .most = 10});
  EXPECT_LE(few.x.size(), 13U);
}

TEST(StreamlinePoints, stay_in_order_near_a_point_at_rest) {
  const FlowField field = quadratic(0, 1, 0);
  const Streamline line = StreamlineTracer(field).trace(0, 0.5);  // falls into the saddle
  ASSERT_EQ(line.downstream, StreamlineEnd::AtRest);
  for (const auto parameter : {StreamlineParameter::Length, StreamlineParameter::Time}) {
    const Streamline even =
        with_even_points(field, line, {.parameter = parameter, .step = fine_step(field, parameter)});
    EXPECT_TRUE(std::is_sorted(even.time.begin(), even.time.end()));
    EXPECT_TRUE(std::is_sorted(even.length.begin(), even.length.end()));
    EXPECT_TRUE(std::is_sorted(even.y.rbegin(), even.y.rend()));
  }
}

TEST(StreamlinePoints, need_a_positive_step) {
  const FlowField field = rotation();
  const Streamline line = StreamlineTracer(field).trace(0.5, 0);
  EXPECT_THAT(message_of<InvalidInput>([&] { with_even_points(field, line, {.step = 0}); }),
              HasSubstr("expected a positive step, found 0"));
}

}  // namespace
}  // namespace batten
