// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/flows/stream_extremes.h>

#include "../support/message_of.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

/// A spline of degree 2 whose values are those of (offset + t) (1 - t) on [0, 1]: coefficients are the blossom at the
/// pairs of inner knots.
std::vector<double> parabola(int cells, double offset) {
  std::vector<double> c;
  for (int i = 0; i < cells + 2; ++i) {
    const double s = std::clamp((i - 1.) / cells, 0., 1.), t = std::clamp(static_cast<double>(i) / cells, 0., 1.);
    c.push_back(offset + (1 - offset) * (s + t) / 2 - s * t);
  }
  return c;
}

Solution product(int nx, int ny, double offset) {
  std::vector<double> c;
  for (const double b : parabola(ny, 0))
    for (const double a : parabola(nx, offset)) c.push_back(a * b);
  return Solution({Interval(0, 1, nx), Interval(0, 1, ny)}, 2, c);
}

TEST(StreamExtremes, lie_between_the_corners_of_cells) {
  // (1/2 + x) (1 - x) y (1 - y) is largest at (1/4, 1/2), where it is 9/64.
  const auto [least, largest] = stream_extremes(FlowField(product(7, 5, 0.5)));
  EXPECT_NEAR(largest.value, 9. / 64, 1e-15);
  EXPECT_NEAR(largest.x, 0.25, 1e-7);
  EXPECT_NEAR(largest.y, 0.5, 1e-7);
  EXPECT_NEAR(least.value, 0, 1e-16);
}

TEST(StreamExtremes, stay_on_the_sides_where_the_flow_does_not_turn) {
  // (2 + x) (1 - x) grows towards the left side, where it is 2.
  const auto largest = stream_extremes(FlowField(product(7, 5, 2))).largest;
  EXPECT_EQ(largest.x, 0);
  EXPECT_NEAR(largest.value, 2 * 0.24, 1e-15);  // at y = 2/5, the first of the two largest corners
}

TEST(StreamExtremes, need_a_stream_function) {
  const auto message = message_of<InvalidInput>([] { stream_extremes(FlowField({}, product(4, 4, 0))); });
  EXPECT_THAT(message, testing::HasSubstr("expected a field with a stream function"));
}

}  // namespace
}  // namespace batten
