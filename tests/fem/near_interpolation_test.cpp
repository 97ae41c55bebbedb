// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/grid_choice.h>
#include <batten/fem/fit.h>

#include "../support/observations.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

using test::franke;
using test::random_observations;
using test::unit_square;

FitOptions with(Smoothing smoothing, const Energy& energy = Energy::thin_plate(), int degree = 3) {
  FitOptions options;
  options.smoothing = smoothing;
  options.energy = energy;
  options.degree = degree;
  return options;
}

double range(const Observations& o) {
  const auto [low, high] = std::minmax_element(o.value.begin(), o.value.end());
  return *high - *low;
}

TEST(NearInterpolation, spends_at_most_200_cycles_on_volcano_rain_gauges_and_random_points) {
  const auto volcano = test::example_data("volcano.csv", 0, 1, 2), rain = test::example_data("rmprecip.csv", 0, 1, 3);
  const auto random = random_observations(2000, 1, franke);
  EXPECT_EQ(volcano.size(), 5307u);
  EXPECT_EQ(rain.size(), 806u);
  for (int degree : {2, 3})
    for (const auto* o : {&volcano, &rain, &random}) {
      const auto region = o == &random ? unit_square(256, 256) : choose_grid(o->x, o->y);
      const auto r = fit_surface(*o, region, with(Smoothing::none(), Energy::thin_plate(), degree));
      EXPECT_LE(r.iterations, 200);
      EXPECT_LE(r.largest_residual, (o == &volcano ? 1e-9 : 1e-6) * range(*o)) << "degree " << degree;
    }
}

TEST(NearInterpolation, points_a_cell_apart_are_met_to_nine_digits_with_values_that_do_not_fit_together) {
  test::Random random(5);
  Observations o;  // a jittered grid: at least one cell between any two points
  for (int j = 1; j < 50; ++j)
    for (int i = 1; i < 50; ++i) {
      o.x.push_back((2.5 * i + 0.7 * random()) / 128);
      o.y.push_back((2.5 * j + 0.7 * random()) / 128);
      o.value.push_back(random());
    }
  for (const auto& energy : {Energy::thin_plate(), Energy::tension(0.5), Energy::membrane()}) {
    const auto r = fit_surface(o, unit_square(128, 128), with(Smoothing::none(), energy));
    EXPECT_LE(r.largest_residual, 1e-9);
    EXPECT_LE(r.iterations, 200);
  }
}

TEST(NearInterpolation, is_the_limit_of_small_lambda) {
  const auto o = random_observations(200, 1, franke);
  const auto none = fit_surface(o, unit_square(64, 64), with(Smoothing::none()));
  const auto small = fit_surface(o, unit_square(64, 64), with(Smoothing::fixed(1e-12)));
  EXPECT_NEAR(none.energy, small.energy, 1e-4 * none.energy);
  EXPECT_GT(none.energy, small.energy);
  EXPECT_NEAR(none.solution.value(0.3, 0.3), small.solution.value(0.3, 0.3), 1e-5);
}

TEST(NearInterpolation, averages_coincident_points_and_says_so) {
  auto o = random_observations(50, 1, franke);
  o.x.push_back(o.x[7]);
  o.y.push_back(o.y[7]);
  o.value.push_back(o.value[7] + 0.5);
  const auto r = fit_surface(o, unit_square(64, 64), with(Smoothing::none()));
  EXPECT_EQ(r.points_merged, 1u);
  EXPECT_THAT(r.notes, testing::Contains(testing::HasSubstr("1 observations were averaged")));
  EXPECT_NEAR(r.fitted[7], o.value[7] + 0.25, 1e-8);
}

TEST(NearInterpolation, of_more_points_than_coefficients_is_least_squares_with_a_note) {
  const auto r = fit_surface(random_observations(2000, 1, franke), unit_square(16, 16), with(Smoothing::none()));
  EXPECT_THAT(r.notes, testing::Contains(testing::HasSubstr("2000 points outnumber 361 coefficients, lambda = 1e-14")));
  EXPECT_EQ(r.lambda, 1e-14);
}

TEST(NearInterpolation, of_the_membrane_warns_that_point_values_are_not_bounded) {
  const auto r =
      fit_surface(random_observations(30, 1, franke), unit_square(32, 32), with(Smoothing::none(), Energy::membrane()));
  EXPECT_THAT(r.notes,
              testing::Contains(testing::AllOf(testing::HasSubstr("cell size"), testing::HasSubstr("tension"))));
}

TEST(Tolerance, is_kept_at_every_point_with_less_energy_than_interpolation) {
  const auto volcano = test::example_data("volcano.csv", 0, 1, 2);
  const auto region = choose_grid(volcano.x, volcano.y);
  const auto within = fit_surface(volcano, region, with(Smoothing::within(1)));
  const auto none = fit_surface(volcano, region, with(Smoothing::none()));
  EXPECT_TRUE(within.tolerance_reached);
  EXPECT_LE(within.largest_residual, 1);
  EXPECT_LT(within.energy, 0.5 * none.energy);
}

// Karush-Kuhn-Tucker: no surface within the tolerance has less energy. Smoothing splines whose largest residual is the
// same are such surfaces.
TEST(Tolerance, gives_less_energy_than_any_smoothing_with_the_same_largest_residual) {
  const auto o = random_observations(300, 2, franke);
  for (double lambda : {1e-8, 1e-6, 1e-5}) {
    const auto smooth = fit_surface(o, unit_square(64, 64), with(Smoothing::fixed(lambda)));
    const auto within = fit_surface(o, unit_square(64, 64), with(Smoothing::within(smooth.largest_residual)));
    EXPECT_TRUE(within.tolerance_reached);
    EXPECT_LT(within.energy, smooth.energy);
  }
}

TEST(Tolerance, may_be_one_for_each_point) {
  auto o = random_observations(400, 3, franke);
  for (std::size_t i = 0; i < o.size(); ++i) {
    o.value[i] += i % 2 ? 0.05 : -0.05;
    o.tolerance.push_back(i % 3 == 0 ? 0.02 : 0.1);
  }
  const auto own = fit_surface(o, unit_square(64, 64), with(Smoothing::within(1)));
  EXPECT_TRUE(own.tolerance_reached);
  double tight = 0, wide = 0;
  for (std::size_t i = 0; i < o.size(); ++i) {
    double& largest = i % 3 == 0 ? tight : wide;
    largest = std::max(largest, std::abs(own.fitted[i] - o.value[i]));
  }
  EXPECT_LE(tight, 0.02);
  EXPECT_LE(wide, 0.1);
  EXPECT_GT(wide, 0.05);
  const auto half = fit_surface(o, unit_square(64, 64), with(Smoothing::within(0.5)));
  EXPECT_GT(half.energy, own.energy);
  o.tolerance.assign(o.size(), 0.02);
  EXPECT_GT(fit_surface(o, unit_square(64, 64), with(Smoothing::within(1))).energy, own.energy);
  o.tolerance[7] = 0;
  EXPECT_THROW(fit_surface(o, unit_square(64, 64), with(Smoothing::within(1))), InvalidInput);
}

TEST(Tolerance, beyond_the_range_of_the_data_is_the_null_space) {
  const auto r = fit_surface(random_observations(300, 2, franke), unit_square(64, 64), with(Smoothing::within(2)));
  EXPECT_EQ(r.energy, 0);
  EXPECT_TRUE(r.tolerance_reached);
}

TEST(Tolerance, refuses_coincident_points_further_apart_than_twice_the_tolerance_and_names_both) {
  auto o = random_observations(50, 1, franke);
  o.x.push_back(o.x[7]);
  o.y.push_back(o.y[7]);
  o.value.push_back(o.value[7] + 0.5);
  try {
    fit_surface(o, unit_square(32, 32), with(Smoothing::within(0.2)));
    FAIL();
  } catch (const InvalidInput& e) {
    EXPECT_THAT(e.what(), testing::AllOf(testing::HasSubstr("observation 8)"), testing::HasSubstr("observation 51)")));
  }
  EXPECT_TRUE(fit_surface(o, unit_square(32, 32), with(Smoothing::within(0.3))).tolerance_reached);
}

TEST(Tolerance, that_the_grid_cannot_reach_is_reported) {
  test::Random random(3);
  const auto r = fit_surface(random_observations(400, 2, [&](double, double) { return random(); }), unit_square(4, 4),
                             with(Smoothing::within(0.01)));
  EXPECT_FALSE(r.tolerance_reached);
  EXPECT_GT(r.largest_residual, 0.01);
}

}  // namespace
}  // namespace batten
