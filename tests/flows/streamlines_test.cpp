// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/hierarchy.h>
#include <batten/fem/null_space.h>
#include <batten/flows/streamlines.h>

#include "../support/laws.h"
#include "../support/message_of.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace batten {
namespace {

using testing::HasSubstr;

constexpr double x0 = 0.5, y0 = 4, pi = std::numbers::pi;
const Rectangle region = {Interval(-1, 2, 12), Interval(3, 5, 8)};

// Σ_k c_k m_k, m = 1, s, t, s², s t, t², with s = x - x0 and t = y - y0.
Solution quadratic(const std::array<double, 6>& c, int degree = 3) {
  const SplineSpace space = finest_space(region, degree);
  std::vector<double> coefficients(space.size());
  QuadraticFunction{c, x0, y0, 1}.add_to(space, coefficients);
  return {region, degree, std::move(coefficients)};
}

// v = ω (-t, s)
FlowField rotation(double omega, int degree = 3) {
  return FlowField(quadratic({0, 0, 0, -omega / 2, 0, -omega / 2}, degree));
}

// v = (s, -t)
FlowField saddle() { return FlowField(quadratic({0, 0, 0, 0, 1, 0})); }

double radius(const Streamline& line, std::size_t i) { return std::hypot(line.x[i] - x0, line.y[i] - y0); }

TEST(Streamlines, of_a_solid_rotation_are_closed_circles_run_through_in_time) {
  const double omega = 2.5, r = 0.7;
  for (const int degree : {3, 4, 5}) {
    const FlowField field = rotation(omega, degree);
    const Streamline line = StreamlineTracer(field).trace(x0 + r, y0);
    EXPECT_TRUE(line.closed());
    EXPECT_EQ(line.x.back(), line.x.front());
    EXPECT_EQ(line.y.back(), line.y.front());
    EXPECT_NEAR(line.time.back(), 2 * pi / omega, 1e-8);
    ASSERT_GT(line.x.size(), 100U);
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      ASSERT_NEAR(radius(line, i), r, 1e-8);
      ASSERT_NEAR(line.x[i], x0 + r * std::cos(omega * line.time[i]), 1e-8);
      ASSERT_NEAR(line.y[i], y0 + r * std::sin(omega * line.time[i]), 1e-8);
      ASSERT_NEAR(field.stream_function(line.x[i], line.y[i]), -omega * r * r / 2, 1e-8);
    }
  }
}

TEST(Streamlines, end_on_the_sides_exactly) {
  const double omega = -2, r = 1.2, angle = std::asin(1 / r);  // of the points where |t| = 1
  const FlowField field = rotation(omega);
  const Streamline line = StreamlineTracer(field).trace(x0 + r, y0);
  EXPECT_EQ(line.upstream, StreamlineEnd::Side);
  EXPECT_EQ(line.downstream, StreamlineEnd::Side);
  EXPECT_EQ(line.y.front(), 5);
  EXPECT_EQ(line.y.back(), 3);
  for (const double x : {line.x.front(), line.x.back()}) EXPECT_NEAR(x, x0 + r * std::cos(angle), 1e-8);
  EXPECT_NEAR(line.time.front(), angle / omega, 1e-8);
  EXPECT_NEAR(line.time.back(), -angle / omega, 1e-8);
  for (std::size_t i = 1; i < line.time.size(); ++i) ASSERT_LT(line.time[i - 1], line.time[i]);
}

TEST(Streamlines, of_an_even_flow_run_from_side_to_side) {
  const FlowField field(quadratic({0, 0, 2, 0, 0, 0}));  // u = 2
  const Streamline line = StreamlineTracer(field).trace(0, 3.3);
  EXPECT_EQ(line.x.front(), -1);
  EXPECT_EQ(line.x.back(), 2);
  for (const double y : line.y) EXPECT_NEAR(y, 3.3, 1e-12);
  EXPECT_NEAR(line.time.front(), -0.5, 1e-10);
  EXPECT_NEAR(line.time.back(), 1, 1e-10);
}

TEST(Streamlines, that_start_on_a_side_go_inwards_only) {
  const FlowField field(quadratic({0, 0, 2, 0, 0, 0}));
  const Streamline line = StreamlineTracer(field).trace(2, 4);
  EXPECT_EQ(line.x.back(), 2);
  EXPECT_EQ(line.time.back(), 0);
  EXPECT_EQ(line.downstream, StreamlineEnd::Side);
  EXPECT_EQ(line.x.front(), -1);
  EXPECT_NEAR(line.time.front(), -1.5, 1e-10);
}

TEST(Streamlines, past_a_saddle_are_hyperbolas) {
  const FlowField field = saddle();
  const Streamline line = StreamlineTracer(field).trace(x0 + 0.3, y0 + 0.5);
  EXPECT_EQ(line.y.front(), 5);
  EXPECT_EQ(line.x.back(), 2);
  EXPECT_NEAR(line.time.front(), std::log(0.5), 1e-8);       // t = 0.5 exp(-time)
  EXPECT_NEAR(line.time.back(), std::log(1.5 / 0.3), 1e-8);  // s = 0.3 exp(time)
  for (std::size_t i = 0; i < line.x.size(); ++i) ASSERT_NEAR((line.x[i] - x0) * (line.y[i] - y0), 0.15, 1e-8);
}

TEST(Streamlines, stop_at_points_of_stagnation) {
  const FlowField field = saddle();
  for (const double t : {0.5, -0.77}) {
    const Streamline line = StreamlineTracer(field).trace(x0, y0 + t);
    EXPECT_EQ(line.downstream, StreamlineEnd::AtRest);
    EXPECT_NEAR(line.x.back(), x0, 1e-9);
    EXPECT_NEAR(line.y.back(), y0, 1e-5);
    EXPECT_EQ(line.upstream, StreamlineEnd::Side);
    EXPECT_EQ(line.y.front(), t > 0 ? 5 : 3);
  }
  const Streamline centre = StreamlineTracer(rotation(1)).trace(x0, y0);
  EXPECT_EQ(centre.x, std::vector<double>{x0});
  EXPECT_EQ(centre.upstream, StreamlineEnd::AtRest);
}

TEST(Streamlines, that_wind_into_a_sink_are_not_closed) {
  const double omega = 3, inflow = 0.01;  // v = ω (-t, s) - inflow (s, t)
  const FlowField field(quadratic({0, 0, 0, -omega / 2, 0, -omega / 2}),
                        quadratic({0, 0, 0, -inflow / 2, 0, -inflow / 2}));
  const Streamline line = StreamlineTracer(field).trace(x0 + 0.4, y0);
  EXPECT_EQ(line.downstream, StreamlineEnd::Length);
  for (std::size_t i = 0; i < line.x.size(); ++i)
    ASSERT_NEAR(radius(line, i), 0.4 * std::exp(-inflow * line.time[i]), 1e-7);
}

TEST(Streamlines, end_after_the_length_asked_for) {
  StreamlineOptions options;
  options.longest = 0.1;  // 0.3 of the region's unit
  const FlowField field = rotation(1);
  const Streamline line = StreamlineTracer(field, options).trace(x0 + 0.6, y0);
  EXPECT_EQ(line.upstream, StreamlineEnd::Length);
  EXPECT_EQ(line.downstream, StreamlineEnd::Length);
  EXPECT_NEAR(line.time.front(), -0.5, 1e-9);  // the angle 0.3 / 0.6
  EXPECT_NEAR(line.time.back(), 0.5, 1e-9);
}

TEST(Streamlines, keep_the_stream_function_of_any_spline) {
  const FlowField field(Solution(region, 3, test::random_vector(15 * 11, 4)));
  const StreamlineTracer tracer(field);
  const double fastest = std::ranges::max(field.samples().arrays[3].values);
  for (const Streamline& line : tracer.evenly_spaced(20)) {
    const double psi = field.stream_function(line.x[0], line.y[0]);
    // Each step errs by at most the tolerance, in units of the longer side.
    const double allowed = static_cast<double>(line.x.size()) * fastest * 1e-10 * 3;
    for (std::size_t i = 0; i < line.x.size(); ++i)
      ASSERT_NEAR(field.stream_function(line.x[i], line.y[i]), psi, allowed);
  }
}

TEST(Streamlines, that_are_evenly_spaced_leave_no_large_gap) {
  const FlowField field(quadratic({0, 0, 1, 0, 0, 0}));
  const auto lines = StreamlineTracer(field).evenly_spaced(9);
  ASSERT_EQ(lines.size(), 9U);
  std::vector<double> heights = {3, 5};
  for (const Streamline& line : lines) heights.push_back(line.y[0]);
  std::sort(heights.begin(), heights.end());
  // Halved three times, on 64 rows of candidates.
  for (std::size_t i = 1; i < heights.size(); ++i) EXPECT_LE(heights[i] - heights[i - 1], 2 / 8. + 2 / 64.);
}

TEST(Streamlines, pass_over_points_at_rest) {
  EXPECT_EQ(StreamlineTracer(rotation(1)).evenly_spaced(5).size(), 5U);  // at rest in the middle
  EXPECT_TRUE(StreamlineTracer(rotation(0)).evenly_spaced(5).empty());
}

TEST(Streamlines, have_samples_with_speed_time_length_and_vorticity) {
  const FlowField field = rotation(3);
  const Streamline line = StreamlineTracer(field).trace(x0, y0 + 0.5);
  const CurveSamples curve = samples_of(field, line);
  ASSERT_EQ(curve.arrays.size(), 4U);
  EXPECT_EQ(curve.arrays[1].values, line.time);
  EXPECT_EQ(curve.arrays[2].values, line.length);
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    ASSERT_NEAR(curve.arrays[0].values[i], 1.5, 1e-7);
    ASSERT_NEAR(curve.arrays[3].values[i], 6, 1e-9);
  }
}

TEST(Streamlines, refuse_points_outside_and_options_that_are_not_positive) {
  const FlowField field = rotation(1);
  EXPECT_THAT(message_of<InvalidInput>([&] { StreamlineTracer(field).trace(2.5, 4); }),
              HasSubstr("the point (2.5, 4) lies outside the region (x from -1 to 2, y from 3 to 5)"));
  EXPECT_THAT(message_of<InvalidInput>([&] { StreamlineTracer(field, {.tolerance = 0}); }), HasSubstr("positive"));
}

}  // namespace
}  // namespace batten
