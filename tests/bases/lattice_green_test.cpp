// SPDX-License-Identifier: MIT
#include <batten/bases/lattice_green.h>
#include <batten/bases/polyharmonic_coefficients.h>
#include <batten/bases/polyharmonic_scheme.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Q = Rational;

TEST(LatticeGreen, has_the_known_values) {
  LatticeGreen green;
  EXPECT_EQ(green(0, 0), PiNumber());
  EXPECT_EQ(green(1, 0), (PiNumber{Q(1) / 4, 0}));
  EXPECT_EQ(green(-1, 1), (PiNumber{0, 1}));
  EXPECT_EQ(green(3, 3), (PiNumber{0, Q(1) + Q(1) / 3 + Q(1) / 5}));
  EXPECT_EQ(green(2, 0), (PiNumber{1, -2}));
  EXPECT_EQ(green(1, -2), (PiNumber{Q(-1) / 4, 2}));
}

TEST(LatticeGreen, is_inverse_to_the_laplacian) {
  LatticeGreen green;
  for (int j = -6; j <= 6; ++j)
    for (int i = -6; i <= 6; ++i) {
      const PiNumber l = green(i + 1, j) + green(i - 1, j) + green(i, j + 1) + green(i, j - 1) - Q(4) * green(i, j);
      EXPECT_EQ(l, (PiNumber{i == 0 && j == 0 ? 1 : 0, 0})) << i << ", " << j;
    }
}

TEST(LatticeGreen, grows_like_the_logarithm) {
  // (log r + γ + (3/2) log 2) / 2π + O(r^-2) [McCrea & Whipple 1940]
  LatticeGreen green;
  const double r = 60,
               expected = (std::log(r) + std::numbers::egamma + 1.5 * std::numbers::ln2) / (2 * std::numbers::pi);
  EXPECT_NEAR(to_double(green(60, 0)), expected, 1 / (r * r));
}

TEST(HarmonicCoefficient, is_exact_at_the_centre) {
  LatticeGreen green;
  EXPECT_EQ(harmonic_coefficient(green, 0, 0), (PiNumber{4, -8}));
  EXPECT_EQ(harmonic_coefficient(green, 1, 0), (PiNumber{3, -8}));
}

TEST(HarmonicCoefficient, has_the_printed_table) {
  // [Warren & Weimer 2001, sec. 5.2.1]
  constexpr double table[5][5] = {{1.4535, 0.4535, -0.1277, -0.0338, -0.0106},
                                  {0.4535, 0.2441, 0.0347, 0.0015, -0.0022},
                                  {-0.1277, 0.0347, 0.0210, 0.0073, 0.0019},
                                  {-0.0338, 0.0015, 0.0073, 0.0048, 0.0023},
                                  {-0.0106, -0.0022, 0.0019, 0.0023, 0.0016}};
  LatticeGreen green;
  for (int j = -4; j <= 4; ++j)
    for (int i = -4; i <= 4; ++i) {
      const double printed = table[std::abs(j)][std::abs(i)];
      EXPECT_NEAR(to_double(harmonic_coefficient(green, i, j)), printed, 0.51e-4) << i << ", " << j;
      EXPECT_NEAR(polyharmonic_coefficient(1, i, j), printed, 0.51e-4) << i << ", " << j;
    }
}

TEST(PolyharmonicCoefficient, of_order_one_agrees_with_the_exact_numbers) {
  LatticeGreen green;
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; j <= i; ++j) {
      const double far = std::min(1., std::pow(std::hypot(i, j), -4));
      EXPECT_NEAR(polyharmonic_coefficient(1, i, j), to_double(harmonic_coefficient(green, i, j)), 4e-15 * far)
          << i << ", " << j;
    }
}

TEST(PolyharmonicCoefficient, far_out_follows_the_bell) {
  // On the torus s = 4 (1 - (u² + v²)/(u + v))^m, u = sin²(α/2), v = sin²(β/2), near 0 that is 4 - m (α⁴ + β⁴)/|ω|² =
  // 4 - (m/4) |ω|² (3 + cos 4θ), and |ω|² cos 4θ is the transform of (24/π) cos(4φ) r^-4: s ~ -(6 m/π) cos(4φ) r^-4.
  for (int m : {1, 2, 3})
    for (auto [i, j] : {std::pair(10000, 0), {10000, 10000}, {6000, 8000}, {0, -3000}}) {
      const double r = std::hypot(i, j), leading = -6 * m / std::numbers::pi * std::cos(4 * std::atan2(j, i));
      EXPECT_NEAR(polyharmonic_coefficient(m, i, j) * std::pow(r, 4), leading, 200 * m / (r * r)) << m;
    }
}

TEST(PolyharmonicCoefficient, far_out_keeps_all_its_digits) {
  // l s = 0 between neighbours that agree to three digits
  const auto s = [](int x, int y) { return polyharmonic_coefficient(1, x, y); };
  for (auto [i, j] : {std::pair(9999, 0), {7000, 7000}, {2500, 9000}}) {
    const double l = s(i + 1, j) + s(i - 1, j) + s(i, j + 1) + s(i, j - 1) - 4 * s(i, j);
    EXPECT_NEAR(l / s(i, j), 0, 8e-14) << i << ", " << j;
  }
}

TEST(PolyharmonicCoefficient, of_higher_order_is_the_convolution_of_lower_ones) {
  // s_(a+b) = s_a s_b / 4. What the sum leaves out beyond |k| = 120 is about ∫ (6/π)² a b r^-8 r dr ~ 4e-12 / 4.
  constexpr int reach = 120;
  const auto one = truncated_laurent_mask(1, 2 * reach + 9), two = truncated_laurent_mask(2, 2 * reach + 9);
  const auto convolution = [&](const Mask2<double>& a, const Mask2<double>& b, int i, int j) {
    double sum = 0;
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) sum += a[{x, y}] * b[{i - x, j - y}];
    return sum / 4;
  };
  for (auto [i, j] : {std::pair(0, 0), {1, 0}, {1, 1}, {2, 0}, {3, 1}, {4, 4}}) {
    EXPECT_NEAR(polyharmonic_coefficient(2, i, j), convolution(one, one, i, j), 1e-12) << i << ", " << j;
    EXPECT_NEAR(polyharmonic_coefficient(3, i, j), convolution(one, two, i, j), 2e-12) << i << ", " << j;
  }
}

TEST(PolyharmonicCoefficient, satisfies_the_two_scale_law) {
  // l^m s = 4^(1-m) l^m[x²,y²]; each sum has terms of absolute sum 8^m
  for (int m : {1, 2, 3}) {
    const auto r = residual(truncated_laurent_mask(m, 31), m);
    const double tolerance = std::pow(8., m) * (m == 1 ? 1e-15 : 2e-15);
    for (int j = -15 + m; j <= 15 - m; ++j)
      for (int i = -15 + m; i <= 15 - m; ++i) EXPECT_NEAR((r[{i, j}]), 0, tolerance) << m << ": " << i << ", " << j;
  }
}

TEST(PolyharmonicCoefficient, refuses_orders_out_of_range) {
  EXPECT_THAT([] { polyharmonic_coefficient(0, 0, 0); }, ThrowsMessage<InvalidInput>(HasSubstr("found 0")));
  EXPECT_THAT([] { polyharmonic_coefficient(9, 0, 0); }, ThrowsMessage<InvalidInput>(HasSubstr("at most 8, found 9")));
}

}  // namespace
}  // namespace batten
