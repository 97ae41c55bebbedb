// SPDX-License-Identifier: MIT
#include <batten/bases/gauss_rule.h>
#include <batten/domains/errors.h>

#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

TEST(GaussRule, integrates_polynomials_of_degree_two_n_minus_one) {
  for (int n = 1; n <= 20; ++n) {
    const GaussRule rule = gauss_rule(n);
    ASSERT_EQ(rule.place.size(), static_cast<std::size_t>(n));
    for (int degree = 0; degree < 2 * n; ++degree) {
      double sum = 0;
      for (std::size_t i = 0; i < rule.place.size(); ++i) sum += rule.weight[i] * std::pow(rule.place[i], degree);
      EXPECT_NEAR(sum, 1. / (degree + 1), 1e-15 * 4) << n << " points, degree " << degree;
    }
  }
}

TEST(GaussRule, refuses_other_numbers_of_points) {
  EXPECT_THROW(gauss_rule(0), InvalidInput);
  EXPECT_THROW(gauss_rule(21), InvalidInput);
}

}  // namespace
}  // namespace batten
