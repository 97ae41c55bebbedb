// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/flows/running_integral.h>

#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

constexpr double tolerance = 1e-14;

TEST(RunningIntegral, is_that_of_the_formula) {
  const RunningIntegral exponential([](double s) { return std::exp(-s); }, Interval(-1, 2, 3));
  for (const double s : {-1., -0.99, 0., 0.5, 1.999, 2.})
    EXPECT_NEAR(exponential(s), std::exp(1.) - std::exp(-s), tolerance * 8) << s;
  EXPECT_EQ(exponential(2), exponential.total());
  EXPECT_EQ(exponential(3), exponential.total());
  EXPECT_EQ(exponential(-2), 0);
}

TEST(RunningIntegral, finds_jumps_and_corners_inside_of_cells) {
  const double jump = 1 / std::sqrt(3.);
  const RunningIntegral step([=](double s) { return s < jump ? 2. : -1.; }, Interval(0, 1, 4));
  EXPECT_NEAR(step(0.55), 1.1, tolerance);
  EXPECT_NEAR(step.total(), 3 * jump - 1, tolerance);
  const RunningIntegral root([](double s) { return std::sqrt(std::abs(s - 0.3)); }, Interval(0, 1, 1));
  EXPECT_NEAR(root.total(), (std::pow(0.3, 1.5) + std::pow(0.7, 1.5)) * 2 / 3, tolerance);
}

TEST(RunningIntegral, knows_the_size_of_what_cancels) {
  const RunningIntegral wave([](double s) { return std::sin(s); }, Interval(0, 2 * std::acos(-1.), 8));
  EXPECT_NEAR(wave.total(), 0, tolerance);
  EXPECT_NEAR(wave.size(), 4, tolerance * 4);
}

TEST(RunningIntegral, ends_for_functions_that_are_rounded_coarsely) {
  const RunningIntegral rough([](double s) { return std::round(1e6 * s) / 1e6; }, Interval(0, 1, 2));
  EXPECT_NEAR(rough.total(), 0.5, 1e-6);
}

TEST(RunningIntegral, refuses_what_is_not_finite) {
  EXPECT_THROW(RunningIntegral([](double s) { return 1 / (s - s); }, Interval(0, 1, 2)), InvalidInput);
}

}  // namespace
}  // namespace batten
