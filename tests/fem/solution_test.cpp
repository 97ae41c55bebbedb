// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/solution.h>

#include "../support/laws.h"
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

Solution wavy(int degree) {
  const Rectangle region{Interval(-3, 5, 20), Interval(10, 16, 13)};
  const auto n = static_cast<std::size_t>((20 + degree) * (13 + degree));
  return {region, degree, test::random_vector(n, 2)};
}

TEST(Solution, samples_are_its_values_and_gradients_at_the_corners_of_the_cells) {
  for (int degree : {2, 3, 4, 5}) {
    const auto s = wavy(degree);
    const auto g = s.samples();
    ASSERT_EQ(g.points, (std::array{21, 14}));
    for (int j = 0; j < 14; ++j)
      for (int i = 0; i < 21; ++i) {
        const double x = s.region().x.coordinate(i), y = s.region().y.coordinate(j);
        const auto k = static_cast<std::size_t>(j * 21 + i);
        EXPECT_NEAR(g.arrays[0].values[k], s.value(x, y), 1e-13);
        EXPECT_NEAR(g.arrays[1].values[3 * k], s.derivative(x, y, 1, 0), 1e-12);
        EXPECT_NEAR(g.arrays[1].values[3 * k + 1], s.derivative(x, y, 0, 1), 1e-12);
        EXPECT_EQ(g.arrays[1].values[3 * k + 2], 0);
      }
  }
}

TEST(Solution, samples_of_degree_1_have_the_mean_of_the_slopes_on_both_sides) {
  const auto s = wavy(1);
  const auto g = s.samples();
  const double h = 8. / 20;
  for (int j = 0; j < 14; ++j)
    for (int i = 1; i < 20; ++i) {
      const auto k = static_cast<std::size_t>(j * 21 + i);
      EXPECT_EQ(g.arrays[0].values[k], s.coefficients()[k]);
      EXPECT_NEAR(g.arrays[1].values[3 * k], (s.coefficients()[k + 1] - s.coefficients()[k - 1]) / (2 * h), 1e-12);
    }
}

TEST(Solution, of_every_degree_has_derivatives_that_are_differences) {
  const double h = 1e-5, x = 0.321, y = 12.34;
  for (int degree : {1, 2, 3, 4, 5}) {
    const auto s = wavy(degree);
    for (int a = 0; a <= degree; ++a)
      EXPECT_NEAR((s.derivative(x + h, y, a, 0) - s.derivative(x - h, y, a, 0)) / (2 * h), s.derivative(x, y, a + 1, 0),
                  1e-5 * std::pow(5, a))
          << degree << ' ' << a;
  }
}

TEST(Solution, derivatives_are_finite_differences) {
  const auto s = wavy(3);
  const double h = 1e-4, x = 0.321, y = 12.34;
  EXPECT_NEAR((s.value(x + h, y) - s.value(x - h, y)) / (2 * h), s.derivative(x, y, 1, 0), 1e-6);
  EXPECT_NEAR((s.value(x, y + h) - s.value(x, y - h)) / (2 * h), s.derivative(x, y, 0, 1), 1e-6);
  EXPECT_NEAR((s.derivative(x, y + h, 1, 0) - s.derivative(x, y - h, 1, 0)) / (2 * h), s.derivative(x, y, 1, 1), 1e-6);
  EXPECT_NEAR((s.derivative(x + h, y, 1, 0) - s.derivative(x - h, y, 1, 0)) / (2 * h), s.derivative(x, y, 2, 0), 1e-6);
  EXPECT_NEAR((s.derivative(x, y + h, 0, 1) - s.derivative(x, y - h, 0, 1)) / (2 * h), s.derivative(x, y, 0, 2), 1e-6);
}

TEST(Solution, is_nan_outside) {
  const auto s = wavy(3);
  EXPECT_TRUE(std::isnan(s.value(-3.01, 12)));
  EXPECT_TRUE(std::isnan(s.value(0, 16.01)));
  EXPECT_FALSE(std::isnan(s.value(5, 16)));
}

TEST(Solution, survives_the_record) {
  for (int degree : {1, 2, 3, 4, 5}) {
    const auto s = wavy(degree);
    const auto t = Solution::from_record(s.to_record());
    EXPECT_EQ(s.value(0.1, 11.3), t.value(0.1, 11.3));
    EXPECT_EQ(t.degree(), degree);
  }
}

TEST(Solution, refuses_records_of_other_things) {
  auto record = wavy(2).to_record();
  record.kind = "flow";
  EXPECT_THROW(Solution::from_record(record), InvalidInput);
  record = wavy(2).to_record();
  record.arrays.clear();
  EXPECT_THROW(Solution::from_record(record), InvalidInput);
  record = wavy(2).to_record();
  record.cells = {3, 3};
  EXPECT_THROW(Solution::from_record(record), InvalidInput);
  for (const int degree : {0, 6}) {
    record = wavy(2).to_record();
    record.degree = degree;
    EXPECT_THROW(Solution::from_record(record), InvalidInput);
  }
}

}  // namespace
}  // namespace batten
