// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/bounded_curve.h>
#include <batten/fem/curve_fit.h>

#include "../support/observations.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

struct Extremes {
  double least, most;
};

Extremes extremes(const HermiteCurve& curve) {
  constexpr int samples = 20'000;
  Extremes found{curve.values[0], curve.values[0]};
  for (int i = 0; i <= samples; ++i) {
    const double v = curve.value(std::lerp(curve.knots.front(), curve.knots.back(), static_cast<double>(i) / samples));
    found = {std::min(found.least, v), std::max(found.most, v)};
  }
  return found;
}

std::vector<double> whole_knots(std::size_t n) {
  std::vector<double> knots(n);
  std::iota(knots.begin(), knots.end(), 0);
  return knots;
}

double misfit(const BoundedCurve& found, const std::vector<double>& knots, const Eigen::VectorXd& points) {
  double worst = 0;
  for (Eigen::Index i = 0; i < points.size(); ++i)
    worst = std::max(worst, std::abs(found.curve.value(knots[static_cast<std::size_t>(i)]) - points[i]));
  return worst;
}

TEST(BoundedCurve, is_the_natural_cubic_where_that_is_inside) {
  const auto knots = whole_knots(6);
  const Eigen::VectorXd points = (Eigen::VectorXd(6) << 1, 2, 4, 3, 3, 2).finished();
  const NaturalCubic natural = interpolating_curve(knots, points), smooth = smoothing_curve(knots, points, {}, 2);
  const auto through = bounded_curve(knots, points, {.minimum = 0, .tolerances = {}, .lambda = {}});
  const auto near = bounded_curve(knots, points, {.minimum = 0, .tolerances = {}, .lambda = 2});
  for (const double t : {0., 0.3, 1.7, 2.5, 4.9, 5.}) {
    EXPECT_NEAR(through.curve.value(t), natural.derivative(t)[0], 1e-13);
    EXPECT_NEAR(near.curve.value(t), smooth.derivative(t)[0], 1e-13);
  }
  EXPECT_NEAR(through.account.energy, 125 * natural.energy(), 1e-10 * through.account.energy);
}

// From 0 at t = 1, where a strip on a flat floor has slope 0, to 1 at t = 2: with a natural end there p = (3 x² - x³)/2
// and ∫ p''² = 3; before t = 1 the strip lies on the floor. The parameter from 0 to 1 makes that 8 times as much.
TEST(BoundedCurve, lies_on_its_bound_and_leaves_it_without_a_slope) {
  const Eigen::VectorXd points = (Eigen::VectorXd(3) << 0, 0, 1).finished();
  const auto found = bounded_curve({0, 1, 2}, points, {.minimum = 0, .tolerances = {}, .lambda = {}});
  EXPECT_NEAR(found.account.energy, 8 * 3, 1e-10);
  EXPECT_NEAR(found.curve.value(0.5), 0, 1e-12);
  EXPECT_NEAR(found.curve.value(1.5), (3 * 0.25 - 0.125) / 2, 1e-10);
}

// A strip through 0 at t = -1 and t = 1, and h at ±3, above the floor -1/4: by hand with one contact at t = 0 where the
// slope is 0 by symmetry. On [0, 1] and [1, 3] (cubics, p'' = g_0, g_1, 0):
// 2 g_0 + g_1 = 6/4, g_0 + 2 (1 + 2) g_1 + 0 = 6 (h/2 - 1/4).
TEST(BoundedCurve, touches_its_bound_between_points) {
  const double h = 3, g_1 = (6 * (h / 2 - 0.25) - 0.75) / 5.5, g_0 = (1.5 - g_1) / 2;
  const double energy = 2 * ((g_0 * g_0 + g_0 * g_1 + g_1 * g_1) / 3 + 2 * g_1 * g_1 / 3);
  const Eigen::VectorXd points = (Eigen::VectorXd(4) << h, 0, 0, h).finished();
  const auto found = bounded_curve({-3, -1, 1, 3}, points, {.minimum = -0.25, .tolerances = {}, .lambda = {}});
  EXPECT_NEAR(found.account.energy, 216 * energy, 1e-3 * 216 * energy);
  EXPECT_NEAR(extremes(found.curve).least, -0.25, 1e-5);
  EXPECT_LE(found.account.energy_gap, 1e-3);
}

TEST(BoundedCurve, stays_within_its_bounds_everywhere) {
  enum Way { Through, Within, Near };
  for (const Way way : {Through, Within, Near})
    for (unsigned seed = 1; seed <= 120; ++seed) {
      SCOPED_TRACE(testing::Message() << way << " " << seed);
      test::Random random(seed);
      const int n = 4 + static_cast<int>(60 * random());
      CurveBounds bounds;
      bounds.minimum = 0;
      if (seed % 2) bounds.maximum = 1;
      bounds.closed = seed % 4 > 1;
      std::vector<double> knots = {0};
      for (int i = 0; i + (bounds.closed ? 0 : 1) < n; ++i) knots.push_back(knots.back() + 0.05 + random());
      Eigen::VectorXd points(n);  // many lie at a bound, in runs
      for (int i = 0; i < n; ++i) {
        const double wave = std::sin(10 * knots[static_cast<std::size_t>(i)] / knots.back()) + 0.3 * random.normal();
        points[i] = std::clamp(wave, 0., seed % 2 ? 1. : 5.);
      }
      const std::vector<double> tolerances(static_cast<std::size_t>(n), 0.05 + 0.3 * random());
      if (way == Within) bounds.tolerances = tolerances;
      if (way == Near) bounds.lambda = std::pow(10, -4 + 6 * random());
      const BoundedCurve found = bounded_curve(knots, points, bounds);
      const Extremes reached = extremes(found.curve);
      EXPECT_GE(reached.least, -1e-11);  // the 1e-12 of the range, below 6
      EXPECT_LE(reached.most, bounds.maximum + 1e-11);
      EXPECT_LE(found.account.energy_gap, 1e-3);
      if (way == Through) {
        EXPECT_LE(misfit(found, knots, points), 1e-13);
      }
      if (way == Within) {
        EXPECT_LE(misfit(found, knots, points), tolerances[0]);
      }
    }
}

TEST(BoundedCurve, may_have_a_tolerance_that_touches_a_bound) {
  const auto knots = whole_knots(5);
  const Eigen::VectorXd points = (Eigen::VectorXd(5) << 1, 2, -0.5, 2, 1).finished();
  const std::vector<double> tolerances(5, 0.5);  // the third value can be 0 only
  const auto found = bounded_curve(knots, points, {.minimum = 0, .tolerances = tolerances, .lambda = {}});
  EXPECT_NEAR(found.curve.value(2), 0, 1e-14);
  EXPECT_GE(extremes(found.curve).least, -1e-12);
}

TEST(BoundedCurve, says_what_cannot_be) {
  const auto knots = whole_knots(3);
  const Eigen::VectorXd points = (Eigen::VectorXd(3) << 0, -2, 1).finished();
  const auto message = [&](const CurveBounds& bounds, const std::string& text) {
    EXPECT_THAT([&] { bounded_curve(knots, points, bounds); }, ThrowsMessage<InvalidInput>(HasSubstr(text)));
  };
  message({.minimum = 1, .maximum = 1, .tolerances = {}, .lambda = {}}, "the minimum must be below the maximum");
  message({.minimum = 0, .tolerances = {}, .lambda = {}}, "-2.000000 at place 1 cannot be kept within the bounds");
  const std::vector<double> tolerances = {1, 1.5, 1}, none = {1, 0, 1};
  message({.minimum = 0, .tolerances = tolerances, .lambda = {}}, "-2.000000 at place 1 cannot be kept");
  message({.minimum = -5, .tolerances = none, .lambda = {}}, "tolerances must be positive, found 0.000000 at place 1");
  message({.minimum = -5, .tolerances = {}, .lambda = -1}, "lambda must be positive, found -1");
}

}  // namespace
}  // namespace batten
