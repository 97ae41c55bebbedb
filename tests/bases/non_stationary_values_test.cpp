// SPDX-License-Identifier: MIT
#include <batten/bases/mask_values.h>
#include <batten/bases/non_stationary_values.h>
#include <batten/bases/scaling_values.h>
#include <batten/domains/errors.h>

#include "../support/masks_by_hand.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using namespace test;
using M = Mask<double>;

/// 2 ∏_i (1 + η_k x)/(1 + η_k), η_k = exp(a_i / 2^k), k the level [reference 4.3].
Scheme exponential_by_hand(const std::vector<double>& roots) {
  return {"exponential", [roots](int level) {
            auto s = M::constant(2);
            for (double a : roots) {
              const double eta = std::exp(std::ldexp(a, -level));
              s *= M(0, {1 / (1 + eta), eta / (1 + eta)});
            }
            return s;
          }};
}

/// (1, 2 + 2σ, 2 + 4σ, 2 + 2σ, 1)/(4 + 4σ), σ_k = sqrt((1 + σ_(k-1))/2) [reference 4.4].
Scheme tension_by_hand(double sigma) {
  return {"tension", [sigma](int level) {
            double s = sigma;
            for (int k = 0; k < level; ++k) s = std::sqrt((1 + s) / 2);
            return M(-2, {1 / (4 + 4 * s), 0.5, (2 + 4 * s) / (4 + 4 * s), 0.5, 1 / (4 + 4 * s)});
          }};
}

TEST(NonStationaryValues, of_the_hyperbolic_hat_are_those_of_its_closed_form) {
  // n = Σ d[i] c(x - i), d = e/(e - 1)^2 (1 - e x)(1 - x/e), c = sinh: n = e/(e - 1)^2 sinh(x) up to 1, then mirrored
  const auto [values, error] = bounded_values_at_level(exponential_by_hand({1, -1}), 3);
  const double factor = std::numbers::e / std::pow(std::numbers::e - 1, 2);
  EXPECT_LT(error, 1e-11);
  for (int i = 0; i <= 16; ++i) EXPECT_NEAR(values[i], factor * std::sinh(std::min(i, 16 - i) / 8.), error) << i;
}

TEST(NonStationaryValues, of_roots_zero_and_one_are_those_of_their_closed_form) {
  // D (D - 1): c = e^x - 1, d = (1 - x)(1 - e x)/(e - 1)
  const auto [values, error] = bounded_values_at_level(exponential_by_hand({0, 1}), 2);
  const double e = std::numbers::e;
  const auto c = [](double x) { return x > 0 ? std::exp(x) - 1 : 0; };
  for (int i = 0; i <= 8; ++i) {
    const double x = i / 4.;
    EXPECT_NEAR(values[i], (c(x) - (1 + e) * c(x - 1) + e * c(x - 2)) / (e - 1), error + 1e-15) << i;
  }
}

TEST(NonStationaryValues, send_regular_polygons_to_circles) {
  for (int n : {4, 5, 12}) {
    const auto [values, error] = bounded_values_at_level(tension_by_hand(std::cos(2 * std::numbers::pi / n)), 3);
    double first = 0;
    for (int m = 0; m < 8; ++m) {
      double x = 0, y = 0;
      for (int i = -3; i <= 3; ++i) {
        x += values[m - 8 * i] * std::cos(2 * std::numbers::pi * i / n);
        y += values[m - 8 * i] * std::sin(2 * std::numbers::pi * i / n);
      }
      if (m == 0) first = std::hypot(x, y);
      EXPECT_NEAR(std::hypot(x, y), first, 8 * error) << n << " " << m;
    }
    EXPECT_LT(error, 1e-11);
  }
}

TEST(NonStationaryValues, of_a_stationary_scheme_are_its_exact_values) {
  for (int level : {0, 1, 3}) {
    const Scheme real("real", to_double(four_point_by_hand().exact_mask()));
    const auto [values, error] = bounded_values_at_level(real, level);
    const auto exact = to_double(values_at_level(four_point_by_hand(), level));
    for (int i = -24; i <= 24; ++i) EXPECT_NEAR(values[i], exact[i], error);
    EXPECT_LT(error, 1e-12);
  }
  const auto [values, error] = bounded_values_at_level(Scheme2("real", to_double(butterfly_by_hand().exact_mask())), 0);
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j) EXPECT_NEAR((values[{i, j}]), i == 0 && j == 0, error);
  const Scheme chaikin("chaikin", centred(to_double(b_spline_by_hand(3).exact_mask())));
  EXPECT_NEAR(bounded_values_at_level(chaikin, 0).values[0], 0.75, 1e-14);
}

TEST(NonStationaryValues, of_masks_that_do_not_settle_are_refused) {
  const Scheme turning("turning", [](int level) {
    return M(0, {0.5 + 0.1 * (level % 2), 1, 0.5 - 0.1 * (level % 2)});
  });
  EXPECT_THAT([&] { return bounded_values_at_level(turning, 0); },
              ThrowsMessage<InvalidInput>(HasSubstr("must settle at a geometric rate, found that those of turning")));
  EXPECT_THAT([] { return bounded_values_at_level(exponential_by_hand({0}), 0); },
              ThrowsMessage<InvalidInput>(HasSubstr("not continuous")));
  EXPECT_THAT([] { return bounded_values_at_level(tension_by_hand(2), -1); },
              ThrowsMessage<InvalidInput>(HasSubstr("found -1")));
}

}  // namespace
}  // namespace batten
