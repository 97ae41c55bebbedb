// SPDX-License-Identifier: MIT
#include <batten/bases/bspline_scheme.h>
#include <batten/bases/exponential_scheme.h>
#include <batten/bases/mask_values.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Complex = std::complex<double>;

const Roots tension = {0., 0., 1., -1.};
const Roots circular = {0., Complex(0, 1.5), Complex(0, -1.5), 0.};
const Roots damped = {Complex(-0.5, 2), Complex(-0.5, -2), 3.};
const std::vector<Roots> all_roots = {{0.}, {1.}, {-2., 0.}, tension, circular, damped, {2., 2., 2.}};

void expect_near(const Mask<double>& a, const Mask<double>& b, double tolerance) {
  for (int i = std::min(a.first()[0], b.first()[0]); i <= std::max(a.last()[0], b.last()[0]); ++i)
    EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

TEST(ExponentialScheme, has_masks_that_sum_to_two_on_every_level) {
  for (const auto& roots : all_roots) {
    const auto scheme = exponential_scheme(roots);
    for (int level = 1; level <= 20; ++level) EXPECT_NEAR(scheme.mask_sum(level), 2, 1e-14);
    EXPECT_EQ(scheme.support().lower[0], 0);
    EXPECT_EQ(scheme.support().upper[0], static_cast<int>(roots.size()));
    EXPECT_FALSE(scheme.is_stationary());
  }
}

TEST(ExponentialScheme, of_roots_zero_is_the_b_spline_scheme) {
  for (std::size_t m = 1; m <= 8; ++m)
    expect_near(exponential_scheme(Roots(m, 0.)).mask(3), to_double(bspline_mask(static_cast<int>(m))), 1e-15);
}

TEST(ExponentialScheme, obeys_the_two_scale_law_of_its_differences) {
  // d_k[x] s_k[x] = 2 d_{k-1}[x^2]
  for (const auto& roots : all_roots)
    for (int level : {1, 2, 5}) {
      const auto d = exponential_difference_mask(roots, level), coarse = exponential_difference_mask(roots, level - 1);
      const double size = absolute_sum(d);
      expect_near(d * exponential_scheme(roots).mask(level), 2. * upsampled(coarse, 2), 1e-14 * size);
    }
}

TEST(ExponentialScheme, differences_annihilate_the_exponentials) {
  const auto d = exponential_difference_mask({3., -1.}, 2);
  for (double a : {3., -1.}) EXPECT_NEAR(evaluate(d, std::exp(-a / 4)), 0, 1e-13 * absolute_sum(d));
  expect_near(exponential_difference_mask({0.}, 3), Mask<double>(0, {8, -8}), 0);
}

TEST(ExponentialGreenFunction, is_the_divided_difference_of_exponentials) {
  for (double x : {0.1, 1., 2.5}) {
    EXPECT_NEAR(exponential_green_function({2.}, x), std::exp(2 * x), 1e-13 * std::exp(2 * x));
    EXPECT_NEAR(exponential_green_function({2., 2.}, x), x * std::exp(2 * x), 1e-13 * std::exp(2 * x));
    EXPECT_NEAR(exponential_green_function({2., -1.}, x), (std::exp(2 * x) - std::exp(-x)) / 3,
                1e-13 * std::exp(2 * x));
    EXPECT_NEAR(exponential_green_function(tension, x), std::sinh(x) - x, 1e-14 * std::exp(x));
    EXPECT_NEAR(exponential_green_function({Complex(0, 1.5), Complex(0, -1.5)}, x), std::sin(1.5 * x) / 1.5, 1e-14);
  }
  EXPECT_EQ(exponential_green_function(tension, -0.1), 0);
  // nearly coincident roots: (e^(x + δ x) - e^x) / δ = x e^x (1 + δ x / 2 + ...)
  EXPECT_NEAR(exponential_green_function({1., 1. + 1e-12}, 2), 2 * std::exp(2.) * (1 + 1e-12), 1e-14 * std::exp(2.));
}

TEST(ExponentialSpline, is_the_difference_of_greens_functions) {
  for (const auto& roots : all_roots) {
    const auto d = exponential_difference_mask(roots, 0);
    for (double x : {0.25, 0.99, 1., 1.7, 2.5, 3.9}) {
      double sum = 0, size = 0;
      for (int i = 0; i <= d.last()[0]; ++i) {
        const double term = d[i] * exponential_green_function(roots, x - i);
        sum += term;
        size += std::abs(term);
      }
      const double expected = x < static_cast<double>(roots.size()) ? sum : 0;
      EXPECT_NEAR(exponential_spline_value(roots, x), expected, 1e-13 * size + 1e-15) << x;
    }
  }
}

TEST(ExponentialSpline, obeys_the_refinement_relation) {
  // n_0(x) = Σ_i s_1[i] n_1(x - i/2), n_1 the spline of the halved roots at twice the position
  for (const auto& roots : all_roots) {
    Roots halved = roots;
    for (Complex& a : halved) a /= 2;
    const auto s = exponential_scheme(roots).mask(1);
    for (double x : {0., 0.3, 0.5, 1., 1.9, 2.6, 3.2}) {
      double sum = 0;
      for (int i = 0; i <= s.last()[0]; ++i) sum += s[i] * exponential_spline_value(halved, 2 * x - i);
      EXPECT_NEAR(exponential_spline_value(roots, x), sum, 1e-13) << x;  // e^(3 m) ε in one order
    }
  }
}

TEST(ExponentialSpline, of_level_k_is_the_scaled_difference_of_greens_functions) {
  // n_k(x) = 2^-k Σ_i d_k[i] c(x - i/2^k); the reference prints 2^k, which does not refine and has integral 4^k
  Roots quartered = tension;
  for (Complex& a : quartered) a /= 4;
  const auto d = exponential_difference_mask(tension, 2);
  for (double x : {0.1, 0.4, 0.8}) {
    double sum = 0;
    for (int i = 0; i <= 4; ++i) sum += 0.25 * d[i] * exponential_green_function(tension, x - 0.25 * i);
    EXPECT_NEAR(exponential_spline_value(quartered, 4 * x), sum, 1e-13 * absolute_sum(d));
  }
}

TEST(ExponentialSpline, of_small_or_coincident_roots_does_not_cancel) {
  for (double x : {0.5, 2., 3.3, 4.75}) {
    const double bspline = bspline_value(6, x);
    EXPECT_NEAR(exponential_spline_value(Roots(6, 0.), x), bspline, 1e-15);
    EXPECT_NEAR(exponential_spline_value({1e-9, -1e-9, 0., 2e-9, Complex(0, 1e-9), Complex(0, -1e-9)}, x), bspline,
                2e-9);
    const double coincident = exponential_spline_value({1., 1., 1., 1., 1., 1.}, x);
    EXPECT_NEAR(exponential_spline_value({1., 1. + 1e-13, 1. - 1e-13, 1., 1., 1.}, x), coincident, 1e-12);
  }
}

TEST(ExponentialSpline, has_integral_one) {
  // the trapezoidal rule at spacing 1/512: its error is at most 1/12 of the squared spacing times the jumps of n'
  for (const auto& roots : {tension, circular, damped}) {
    double sum = 0;
    const int steps = 512, m = static_cast<int>(roots.size());
    for (int i = 0; i < m * steps; ++i) sum += exponential_spline_value(roots, static_cast<double>(i) / steps) / steps;
    EXPECT_NEAR(sum, 1, 1e-4);
  }
}

TEST(ExponentialScheme, refuses_roots_that_give_no_real_spline) {
  EXPECT_THAT(
      [] {
        return exponential_scheme({Complex(1, 2), 0.});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("conjugate pairs, found 1.000000 + 2.000000i")));
  EXPECT_THROW(exponential_scheme({}), InvalidInput);
  EXPECT_THROW(exponential_scheme(Roots(33, 0.)), InvalidInput);
  EXPECT_THROW(exponential_scheme({std::nan("")}), InvalidInput);
  EXPECT_THROW(exponential_scheme({701.}), InvalidInput);
  EXPECT_THROW(exponential_scheme({Complex(0, 7), Complex(0, -7)}), InvalidInput);
  EXPECT_THROW(exponential_difference_mask({0.}, -1), InvalidInput);
  EXPECT_NO_THROW(exponential_scheme({700., -700.}).mask(1));
}

}  // namespace
}  // namespace batten
