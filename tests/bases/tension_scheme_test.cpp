// SPDX-License-Identifier: MIT
#include <batten/bases/bspline_scheme.h>
#include <batten/bases/exponential_scheme.h>
#include <batten/bases/tension_scheme.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(TensionScheme, of_sigma_one_is_the_cubic_b_spline) {
  for (int level : {1, 2, 9}) EXPECT_EQ(tension_scheme(1).mask(level), to_double(shifted(bspline_mask(4), {-2})));
}

TEST(TensionScheme, is_the_exponential_scheme_of_order_four) {
  for (const std::complex<double> g : {std::complex<double>(1.5), std::complex<double>(0, 1.2)}) {
    const auto tension = tension_scheme(std::cosh(g).real());
    const auto exponential = exponential_scheme({0., 0., g, -g});
    for (int level = 1; level <= 12; ++level)
      for (int i = -2; i <= 2; ++i) EXPECT_NEAR(tension.mask(level)[i], exponential.mask(level)[i + 2], 1e-15);
    EXPECT_NEAR(std::abs(tension.structure().roots[2] - g), 0, 1e-15);
  }
}

TEST(TensionScheme, halves_the_distance_of_its_parameter_from_one_each_step) {
  // 0 < (1 - σ_k) / (1 - σ_{k-1}) < 1/2 [Warren & Weimer 2001, sec. 4.4.4]
  for (double sigma_0 : {-0.99, -0.5, 0., 0.5, 2., 50.})
    for (int k = 1; k < 10; ++k) {
      const double ratio = (1 - tension_parameter(sigma_0, k)) / (1 - tension_parameter(sigma_0, k - 1));
      EXPECT_GT(ratio, 0);
      EXPECT_LT(ratio, 0.5);
    }
  EXPECT_NEAR(tension_parameter(std::cosh(2.), 3), std::cosh(2. / 8), 1e-15);
  EXPECT_NEAR(tension_parameter(std::cos(2.), 3), std::cos(2. / 8), 1e-15);
}

/// One step on a closed polygon of complex numbers.
std::vector<std::complex<double>> step(const Mask<double>& s, const std::vector<std::complex<double>>& p) {
  const int n = static_cast<int>(p.size());
  std::vector<std::complex<double>> fine(p.size() * 2);
  for (int i = 0; i < 2 * n; ++i)
    for (int j = -2; j <= n + 1; ++j)
      fine[static_cast<std::size_t>(i)] += s[i - 2 * j] * p[static_cast<std::size_t>((j + n) % n)];
  return fine;
}

TEST(TensionScheme, sends_regular_polygons_to_circles) {
  // Every polygon is regular, the limit a circle [Warren & Weimer 2001, sec. 4.4.2]; n = 4 is the diamond.
  for (int n : {4, 3, 7}) {
    const auto scheme = tension_scheme(std::cos(2 * std::numbers::pi / n));
    std::vector<std::complex<double>> p;
    for (int i = 0; i < n; ++i) p.push_back(std::polar(1., 2 * std::numbers::pi * i / n));
    for (int level = 1; level <= 6; ++level) {
      p = step(scheme.mask(level), p);
      for (std::size_t i = 0; i < p.size(); ++i) {
        EXPECT_NEAR(std::abs(p[i]), std::abs(p[0]), 1e-15);
        EXPECT_NEAR(std::abs(p[(i + 1) % p.size()] - p[i]), std::abs(p[1] - p[0]), 1e-15);
      }
    }
  }
}

TEST(TensionScheme, needs_the_parameter_updated_before_the_mask) {
  // With σ_{k-1} in the mask of the step to level k the diamond gives no regular octagon.
  std::vector<std::complex<double>> p = {1., {0., 1.}, -1., {0., -1.}};
  const double all = 4;
  p = step(Mask<double>(-2, {1 / all, 0.5, 2 / all, 0.5, 1 / all}), p);
  EXPECT_GT(std::abs(std::abs(p[0]) - std::abs(p[1])), 0.1);
}

TEST(TensionScheme, refuses_a_parameter_of_minus_one_or_less) {
  EXPECT_THAT([] { return tension_scheme(-1); }, ThrowsMessage<InvalidInput>(HasSubstr("greater than -1, found -1")));
  EXPECT_THROW(tension_scheme(std::nan("")), InvalidInput);
  EXPECT_THROW(tension_scheme(INFINITY), InvalidInput);
  EXPECT_THROW(tension_parameter(1, -1), InvalidInput);
  EXPECT_TRUE(std::isfinite(tension_scheme(1e300).mask()[0]));
}

}  // namespace
}  // namespace batten
