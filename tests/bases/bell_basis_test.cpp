// SPDX-License-Identifier: MIT
#include <batten/bases/bell_basis.h>
#include <batten/bases/polyharmonic_residual.h>
#include <batten/domains/errors.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Digits100 = boost::multiprecision::cpp_bin_float_100;

constexpr std::array radii = {0.01, 0.3, 0.999, 1.2, 1.26, 1.9, 2.4, 2.51, 3.3, 3.7, 3.8, 5., 12., 100., 1e4};
constexpr std::array angles = {0.01, 0.4, 0.78, 2.5};

/// The definition, in digits enough for any cancellation.
Digits100 defined_bell(int m, const Digits100& x, const Digits100& y) {
  const auto l = to_double(power(five_point_laplacian(), m));
  Digits100 sum = 0, scale = 4 * boost::math::constants::pi<Digits100>();
  for (int k = 1; k < m; ++k) scale *= 4 * k * k;
  for (int j = -m; j <= m; ++j)
    for (int i = -m; i <= m; ++i) {
      const Digits100 rho = (x - i) * (x - i) + (y - j) * (y - j);
      if (rho == 0 || l[{i, j}] == 0) continue;
      sum += l[{i, j}] * pow(rho, m - 1) * log(rho);
    }
  return sum / scale;
}

/// Σ_i p(i) n(x - i) over a disc around x whose edge is smoothed over several cells, so that the points on it do not
/// count: erfc(±6) is 0 or 2 to rounding.
template <class Polynomial>
double sum_over_disc(const BellBasis& bell, double x, double y, Polynomial&& p) {
  constexpr double radius = 30;
  double sum = 0;
  for (int j = -40; j <= 40; ++j)
    for (int i = -40; i <= 40; ++i) {
      const double inside = 0.5 * std::erfc(12 * (std::hypot(i - x, j - y) / radius - 0.6));
      sum += inside * p(i, j) * bell.value(x - i, y - j);
    }
  return sum;
}

TEST(BellBasis, values_near_and_far_keep_all_digits) {
  for (int m : {1, 2, 3, 5}) {
    const BellBasis bell(m);
    for (double r : radii)
      for (double a : angles) {
        const double x = r * std::cos(a), y = r * std::sin(a);
        const double expected = static_cast<double>(defined_bell(m, x, y));
        const double tolerance = r > 1.25 * m ? 1e-14 * std::pow(r, -4) : 1e-14;
        EXPECT_NEAR(bell.value(x, y), expected, tolerance) << m << " at " << x << ", " << y;
      }
  }
}

TEST(BellBasis, gradient_and_laplacian_are_the_derivatives_of_the_value) {
  const Digits100 h("1e-20");
  for (int m : {1, 2, 3}) {
    const BellBasis bell(m);
    for (double r : radii)
      for (double a : angles) {
        const double x = r * std::cos(a), y = r * std::sin(a);
        const auto n = [&](int i, int j) { return defined_bell(m, x + i * h, y + j * h); };
        const double dx = static_cast<double>((n(1, 0) - n(-1, 0)) / (2 * h));
        const double dy = static_cast<double>((n(0, 1) - n(0, -1)) / (2 * h));
        const double lap = static_cast<double>((n(1, 0) + n(-1, 0) + n(0, 1) + n(0, -1) - 4 * n(0, 0)) / (h * h));
        const double size = r > 1.25 * m ? std::pow(r, -5) : std::max(1., 1 / r);
        EXPECT_NEAR(bell.gradient(x, y)[0], dx, 1e-13 * size) << m << " at " << x << ", " << y;
        EXPECT_NEAR(bell.gradient(x, y)[1], dy, 1e-13 * size) << m << " at " << x << ", " << y;
        EXPECT_NEAR(bell.laplacian(x, y), lap, 1e-13 * (r > 1.25 * m ? std::pow(r, -6) : 1)) << m << " at r = " << r;
      }
  }
}

TEST(BellBasis, of_order_one_has_the_polar_closed_form) {
  const BellBasis bell(1);
  for (double r : radii)
    for (double a : angles)
      EXPECT_NEAR(bell.value(r * std::cos(a), r * std::sin(a)), harmonic_bell(r, a),
                  2e-15 * std::min(1., std::pow(r, -4)) + (r < 1.3 ? 2e-15 : 0))
          << r << " " << a;
}

TEST(BellBasis, of_order_one_has_spikes_at_five_grid_points) {
  const BellBasis bell(1);
  EXPECT_EQ(bell.value(0, 0), INFINITY);
  for (auto [x, y] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) EXPECT_EQ(bell.value(x, y), -INFINITY);
  EXPECT_TRUE(std::isfinite(bell.value(1, 1)));
}

TEST(BellBasis, decays_like_the_fourth_power_of_the_distance) {
  for (int m : {1, 2, 3}) {
    const BellBasis bell(m);
    for (double a : {0., 0.2, 0.5}) {
      const double r = 1e4, leading = -m / (2 * std::numbers::pi) * std::cos(4 * a) * std::pow(r, -4);
      // the next term is of relative size r^-2 times a polynomial in m
      EXPECT_NEAR(bell.value(r * std::cos(a), r * std::sin(a)), leading, 100 * m * std::pow(r, -6)) << m;
    }
  }
}

TEST(BellBasis, translates_sum_to_one_and_keep_linear_functions) {
  for (int m : {1, 2, 3}) {
    const BellBasis bell(m);
    EXPECT_NEAR(sum_over_disc(bell, 0.3, 0.1, [](int, int) { return 1; }), 1, 1e-13) << m;
    EXPECT_NEAR(sum_over_disc(bell, 0.3, 0.1, [](int i, int j) { return 2 * i - j; }), 0.5, 1e-12) << m;
  }
}

TEST(BellBasis, degrees_two_and_three_over_discs_gain_m_sixteenths_of_the_laplacian) {
  for (int m : {2, 3}) {
    const BellBasis bell(m);
    const double x = 0.37, y = 0.11, gain = m / 16.;
    const auto square = sum_over_disc(bell, x, y, [](int i, int) { return i * i; });
    const auto harmonic = sum_over_disc(bell, x, y, [](int i, int j) { return i * j; });
    const auto cubic = sum_over_disc(bell, x, y, [](int i, int j) { return i * i * i + i * j * j; });
    EXPECT_NEAR(square, x * x + 2 * gain, 1e-12) << m;
    EXPECT_NEAR(harmonic, x * y, 1e-12) << m;
    EXPECT_NEAR(cubic, x * x * x + x * y * y + 8 * x * gain, 1e-10) << m;
  }
}

/// Σ_k cos(2π k·x) / |2π k|², k in Z² without 0, summed over k_y in closed form: the Green's function of the torus.
double periodic_green(double x, double y) {
  constexpr double pi = std::numbers::pi;
  double sum = (y * y - y + 1. / 6) / 2;
  for (int k = 1; k < 60; ++k)
    sum += std::cos(2 * pi * k * x) * std::cosh(2 * pi * k * (0.5 - y)) / (2 * pi * k * std::sinh(pi * k));
  return sum;
}

TEST(BellBasis, of_order_one_gives_squares_a_spike_at_every_grid_point) {
  // The bell's transform has zeros of order 2 at 2π k only: -∂²n̂ = -2 / |2π k|² there.
  const BellBasis bell(1);
  const double x = 0.37, y = 0.11, sum = sum_over_disc(bell, x, y, [](int i, int) { return i * i; });
  EXPECT_NEAR(sum, x * x + 1. / 8 - 2 * periodic_green(x, y), 1e-12);
}

TEST(BellBasis, sums_with_fourth_powers_grow_with_the_area_of_the_disc) {
  // x^4 has the part r^4 cos(4φ) / 8: its integral with -m/(2π) cos(4φ) r^-4 over r < R is -m R² / 32.
  const BellBasis bell(2);
  const auto sum = [&](int radius) {
    double total = 0;
    for (int j = -radius; j <= radius; ++j)
      for (int i = -radius; i <= radius; ++i)
        if (i * i + j * j <= radius * radius) total += std::pow(i, 4) * bell.value(i, j);
    return total;
  };
  EXPECT_NEAR((sum(160) - sum(80)) / (160 * 160 - 80 * 80), -2. / 32, 2e-3);
}

TEST(BellBasis, of_order_two_solves_the_thin_plate_equation_between_grid_points) {
  // Δn_2 = Σ l[i] n_1(x - i): the Laplacian of a bell is the five-point Laplacian of the one below.
  const BellBasis one(1), two(2);
  for (auto [x, y] : {std::pair(0.3, 0.2), {1.7, -0.4}, {4.1, 3.3}, {20.2, 5.5}}) {
    const double l =
        one.value(x + 1, y) + one.value(x - 1, y) + one.value(x, y + 1) + one.value(x, y - 1) - 4 * one.value(x, y);
    EXPECT_NEAR(two.laplacian(x, y), l, 1e-14);
  }
}

TEST(BellBasis, refuses_orders_below_one) {
  EXPECT_THAT([] { BellBasis(0); }, ThrowsMessage<InvalidInput>(HasSubstr("at least 1, found 0")));
  EXPECT_THAT([] { BellBasis(9); }, ThrowsMessage<InvalidInput>(HasSubstr("at most 8, found 9")));
}

TEST(PolyharmonicGreen, has_the_printed_forms) {
  // [Warren & Weimer 2001, sec. 5.1.1]
  const double r2 = 0.09 + 0.25;
  EXPECT_DOUBLE_EQ(polyharmonic_green(1, 0.3, 0.5), std::log(r2) / (4 * std::numbers::pi));
  EXPECT_DOUBLE_EQ(polyharmonic_green(2, 0.3, 0.5), r2 * std::log(r2) / (16 * std::numbers::pi));
  EXPECT_EQ(polyharmonic_green(2, 0, 0), 0);
}

}  // namespace
}  // namespace batten
