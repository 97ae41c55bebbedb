// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/fit.h>

#include "../support/observations.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
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

double largest_difference(const FitResult& a, const FitResult& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.fitted.size(); ++i) largest = std::max(largest, std::abs(a.fitted[i] - b.fitted[i]));
  return largest;
}

TEST(Fit, reproduces_linear_data_for_every_lambda) {
  const auto linear = [](double x, double y) { return 700 + 30 * x - 20 * y; };
  const auto o = random_observations(500, 1, linear);
  for (int degree : {2, 3})
    for (double lambda : {0., 1e-12, 1e-6, 1., 1e6, 1e12}) {
      const auto r = fit_surface(o, unit_square(64, 48), with(Smoothing::fixed(lambda), Energy::thin_plate(), degree));
      for (int k = 0; k <= 50; ++k) {
        const double x = k / 50., y = k * 7 % 51 / 50.;
        EXPECT_NEAR(r.solution.value(x, y), linear(x, y), 1e-10 * 730) << "lambda " << lambda;
      }
      EXPECT_LT(r.energy, 1e-12);
    }
}

TEST(Fit, reproduces_constants_with_every_energy) {
  const auto o = random_observations(100, 1, [](double, double) { return 5.; });
  for (const auto& energy : {Energy::thin_plate(), Energy::membrane(), Energy::tension(0.4)})
    for (const auto& smoothing :
         {Smoothing::automatic(), Smoothing::fixed(1), Smoothing::none(), Smoothing::within(0.1)}) {
      const auto r = fit_surface(o, unit_square(32, 32), with(smoothing, energy));
      EXPECT_NEAR(r.solution.value(0.1, 0.93), 5, 5e-10);
    }
}

TEST(Fit, an_offset_of_a_million_changes_it_by_no_more_than_its_rounding) {
  const auto o = random_observations(2000, 1, franke);
  auto moved = o;
  for (double& z : moved.value) z += 1e6;
  for (const auto& s : {Smoothing::fixed(1e-7), Smoothing::automatic(), Smoothing::none()}) {
    const auto a = fit_surface(o, unit_square(96, 96), with(s)), b = fit_surface(moved, unit_square(96, 96), with(s));
    for (std::size_t i = 0; i < a.fitted.size(); ++i) EXPECT_NEAR(b.fitted[i] - 1e6, a.fitted[i], 1e-10 * 1e6);
    EXPECT_NEAR(a.energy, b.energy, 1e-6 * a.energy);
  }
}

TEST(Fit, does_not_depend_on_units_or_on_where_the_region_lies) {
  const auto o = random_observations(800, 1, franke);
  auto scaled = o;
  for (double& x : scaled.x) x = 1000 * x - 400;
  for (double& y : scaled.y) y = 1000 * y + 77;
  for (double& z : scaled.value) z *= 250;
  const Rectangle there{Interval(-400, 600, 64), Interval(77, 1077, 64)};
  const auto a = fit_surface(o, unit_square(64, 64), with(Smoothing::fixed(1e-7)));
  const auto b = fit_surface(scaled, there, with(Smoothing::fixed(1e-7)));
  for (std::size_t i = 0; i < a.fitted.size(); ++i) EXPECT_NEAR(b.fitted[i], 250 * a.fitted[i], 250 * 1e-8);
  EXPECT_NEAR(b.energy, 250 * 250 * a.energy, 250 * 250 * 1e-6 * a.energy);
}

TEST(Fit, swaps_axes_with_the_data) {
  const auto o = random_observations(800, 1, franke);
  auto swapped = o;
  std::swap(swapped.x, swapped.y);
  for (const auto& energy : {Energy::thin_plate(), Energy::tension(0.2)}) {
    const auto a = fit_surface(o, {Interval(0, 1, 64), Interval(0, 1, 40)}, with(Smoothing::fixed(1e-7), energy));
    const auto b = fit_surface(swapped, {Interval(0, 1, 40), Interval(0, 1, 64)}, with(Smoothing::fixed(1e-7), energy));
    EXPECT_LT(largest_difference(a, b), 1e-8);
  }
}

TEST(Fit, is_a_mirror_image_for_mirrored_data) {
  const auto o = random_observations(800, 1, franke);
  auto mirrored = o;
  for (double& x : mirrored.x) x = 1 - x;
  const auto a = fit_surface(o, unit_square(61, 64), with(Smoothing::fixed(1e-7)));
  const auto b = fit_surface(mirrored, unit_square(61, 64), with(Smoothing::fixed(1e-7)));
  EXPECT_LT(largest_difference(a, b), 1e-8);
}

TEST(Fit, reproduces_polynomials_of_its_degree_with_dense_exact_data) {
  for (int degree : {2, 3}) {
    const auto p = [&](double x, double y) {
      return degree == 2 ? 1 + x - 3 * x * y + 2 * x * x * y * y
                         : x * x * x - 2 * x * y * y * y + x * x * x * y * y * y;
    };
    const auto r = fit_surface(random_observations(4000, 1, p), unit_square(16, 16),
                               with(Smoothing::fixed(1e-14), Energy::thin_plate(), degree));
    EXPECT_NEAR(r.solution.value(0.013, 0.98), p(0.013, 0.98), 1e-8);
    EXPECT_LT(r.largest_residual, 1e-8);
  }
}

/// Root-mean-square error on a fine grid, away from nothing.
double l2_error(const Solution& p, double (*f)(double, double)) {
  double sum = 0;
  constexpr int n = 150;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double x = (i + 0.5) / n, y = (j + 0.5) / n, e = p.value(x, y) - f(x, y);
      sum += e * e;
    }
  return std::sqrt(sum / (n * n));
}

TEST(Fit, converges_with_order_four_for_cubics_and_three_for_quadratics) {
  for (int degree : {2, 3}) {
    std::vector<double> errors;
    for (int cells : {16, 32, 64}) {
      const auto o = random_observations(static_cast<std::size_t>(25) * cells * cells, 1, franke);
      errors.push_back(
          l2_error(fit_surface(o, unit_square(cells, cells),
                               with(Smoothing::fixed(1e-4 * std::pow(cells, -6.)), Energy::thin_plate(), degree))
                       .solution,
                   franke));
    }
    EXPECT_GT(std::log2(errors[0] / errors[1]), degree + 1 - 0.3) << errors[0] << " " << errors[1];
    EXPECT_GT(std::log2(errors[1] / errors[2]), degree + 1 - 0.3) << errors[1] << " " << errors[2];
  }
}

TEST(Fit, energy_falls_and_residual_grows_with_lambda) {
  const auto o = random_observations(1000, 1, franke);
  double energy = INFINITY, residual = 0;
  for (double lambda = 1e-12; lambda < 1e3; lambda *= 10) {
    const auto r = fit_surface(o, unit_square(64, 64), with(Smoothing::fixed(lambda)));
    EXPECT_LT(r.energy, energy);
    EXPECT_GT(r.rms_residual, residual);
    energy = r.energy;
    residual = r.rms_residual;
  }
}

TEST(Fit, weights_count_like_repeated_observations) {
  auto weighted = random_observations(300, 1, franke);
  auto repeated = weighted;
  weighted.weight.assign(300, 1.);
  for (std::size_t i = 0; i < 50; ++i) {
    weighted.weight[i] = 3;
    for (int k = 0; k < 2; ++k) {
      repeated.x.push_back(weighted.x[i]);
      repeated.y.push_back(weighted.y[i]);
      repeated.value.push_back(weighted.value[i]);
    }
  }
  const auto a = fit_surface(weighted, unit_square(32, 32), with(Smoothing::fixed(1e-5)));
  const auto b = fit_surface(repeated, unit_square(32, 32), with(Smoothing::fixed(1e-5)));
  for (std::size_t i = 0; i < 300; ++i) EXPECT_NEAR(a.fitted[i], b.fitted[i], 1e-9);
}

TEST(Fit, leaves_out_points_of_weight_zero_and_outside) {
  auto o = random_observations(300, 1, franke);
  const auto plain = fit_surface(o, unit_square(32, 32), with(Smoothing::fixed(1e-5)));
  o.weight.assign(300, 1.);
  for (const auto& [x, y, w] : {std::array{0.5, 0.5, 0.}, {1.5, 0.5, 1.}, {0.5, -0.1, 1.}}) {
    o.x.push_back(x);
    o.y.push_back(y);
    o.value.push_back(1e6);
    o.weight.push_back(w);
  }
  const auto r = fit_surface(o, unit_square(32, 32), with(Smoothing::fixed(1e-5)));
  EXPECT_EQ(r.points_outside, 2u);
  EXPECT_EQ(r.points_used, 300u);
  EXPECT_TRUE(std::isnan(r.fitted[301]));
  for (std::size_t i = 0; i < 300; ++i) EXPECT_EQ(r.fitted[i], plain.fitted[i]);
}

TEST(Fit, has_the_same_bits_for_every_number_of_threads) {
  const auto o = random_observations(3000, 1, franke);
  const int before = omp_get_max_threads();
  for (const auto& s : {Smoothing::automatic(), Smoothing::none()}) {
    std::vector<std::vector<double>> coefficients;
    for (int threads : {1, 2}) {
      omp_set_num_threads(threads);
      const auto r = fit_surface(o, unit_square(100, 90), with(s));
      coefficients.emplace_back(r.solution.coefficients().begin(), r.solution.coefficients().end());
    }
    EXPECT_EQ(coefficients[0], coefficients[1]);
  }
  omp_set_num_threads(before);
}

TEST(Fit, degenerate_data_follow_the_null_space) {
  const auto message = [](const Observations& o, const Energy& energy) -> std::string {
    try {
      fit_surface(o, unit_square(8, 8), with(Smoothing::fixed(1), energy));
    } catch (const InvalidInput& e) {
      return e.what();
    }
    return "";
  };
  const Observations one{{0.5}, {0.25}, {3}, {}}, line{{0.1, 0.2, 0.3, 0.7}, {0.2, 0.3, 0.4, 0.8}, {1, 2, 3, 4}, {}};
  EXPECT_THAT(message(one, Energy::thin_plate()),
              testing::HasSubstr("three points that are not on one line, found 1 point"));
  EXPECT_THAT(message(line, Energy::thin_plate()), testing::HasSubstr("found 4 points on one line"));
  EXPECT_EQ(message(one, Energy::membrane()), "");
  EXPECT_EQ(message(one, Energy::tension(0.5)), "");
  EXPECT_EQ(message(line, Energy::membrane()), "");
  const Observations triangle{{0.1, 0.9, 0.5}, {0.1, 0.2, 0.9}, {1, 2, 3}, {}};
  const auto r = fit_surface(triangle, unit_square(8, 8), with(Smoothing::fixed(1)));
  EXPECT_LT(r.largest_residual, 1e-10);
}

TEST(Fit, says_what_is_wrong_with_observations) {
  const auto message = [](Observations o, FitOptions options = {}) -> std::string {
    try {
      fit_surface(o, unit_square(8, 8), options);
    } catch (const InvalidInput& e) {
      return e.what();
    }
    return "";
  };
  const auto good = random_observations(20, 1, franke);
  auto bad = good;
  bad.value[3] = NAN;
  EXPECT_THAT(message(bad), testing::HasSubstr("observation 4"));
  bad = good;
  bad.weight.assign(20, 1);
  bad.weight[5] = -2;
  EXPECT_THAT(message(bad), testing::HasSubstr("weights that are not negative, found -2 at observation 6"));
  bad.weight.assign(20, 0);
  EXPECT_THAT(message(bad), testing::HasSubstr("all 20 zero"));
  bad = good;
  for (double& x : bad.x) x += 7;
  EXPECT_THAT(message(bad), testing::HasSubstr("at least one point inside the region, found none of 20"));
  bad = good;
  bad.y.pop_back();
  EXPECT_THAT(message(bad), testing::HasSubstr("of one length"));
  EXPECT_THAT(message(good, with(Smoothing::fixed(-1))), testing::HasSubstr("not negative, found -1"));
  EXPECT_THAT(message(good, with(Smoothing::within(0))), testing::HasSubstr("positive tolerance"));
  auto options = with(Smoothing::none());
  options.standard_error = true;
  EXPECT_THAT(message(good, options), testing::HasSubstr("needs smoothing"));
}

}  // namespace
}  // namespace batten
