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
  for (int degree : {2, 3}) {
    const auto s = wavy(degree);
    const auto g = s.samples();
    ASSERT_EQ(g.points, (std::array{21, 14}));
    for (int j = 0; j < 14; ++j)
      for (int i = 0; i < 21; ++i) {
        const double x = s.region().x.coordinate(i), y = s.region().y.coordinate(j);
        const auto k = static_cast<std::size_t>(j * 21 + i);
        EXPECT_NEAR(g.arrays[0].values[k], s.value(x, y), 1e-14 * 10);
        EXPECT_NEAR(g.arrays[1].values[3 * k], s.derivative(x, y, 1, 0), 1e-12);
        EXPECT_NEAR(g.arrays[1].values[3 * k + 1], s.derivative(x, y, 0, 1), 1e-12);
        EXPECT_EQ(g.arrays[1].values[3 * k + 2], 0);
      }
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
  const auto s = wavy(2);
  const auto t = Solution::from_record(s.to_record());
  EXPECT_EQ(s.value(0.1, 11.3), t.value(0.1, 11.3));
  EXPECT_EQ(t.degree(), 2);
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
}

}  // namespace
}  // namespace batten
