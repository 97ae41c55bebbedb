// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/corner_samples.h>

#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

VariationalDomain rectangle(int degree) {
  VariationalDomain domain{Breakpoints::uniform(-1, 3, 8)};
  domain.y = Breakpoints::uniform(0, 1, 3);
  domain.degree = degree;
  return domain;
}

TEST(CornerSamples, are_the_values_of_the_spline) {
  for (int degree : {1, 2, 3}) {
    const SplineLevel level(rectangle(degree));
    // Greville coefficients of 2 + x - 3 y
    const auto u = level.x().greville(), v = level.y().greville();
    Eigen::VectorXd c(level.size());
    for (int f = 0; f < level.size(); ++f) {
      const auto i = static_cast<std::size_t>(level.grid(f) % level.x().size());
      const auto j = static_cast<std::size_t>(level.grid(f) / level.x().size());
      c[f] = 2 + (-1 + level.x().breakpoints().unit() * u[i]) - 3 * level.y().breakpoints().unit() * v[j];
    }
    const GridSamples samples = corner_samples(level, c);
    ASSERT_EQ(samples.points, (std::array{9, 4}));
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 9; ++i) {
        const double x = samples.origin[0] + i * samples.spacing[0], y = samples.origin[1] + j * samples.spacing[1];
        EXPECT_DOUBLE_EQ(x, -1 + 0.5 * i);
        EXPECT_NEAR(samples.arrays[0].values[static_cast<std::size_t>(i + 9 * j)], 2 + x - 3 * y, 1e-13);
      }
  }
}

TEST(CornerSamples, are_blank_outside_of_a_mask) {
  VariationalDomain domain = rectangle(1);
  domain.inside.assign(24, 1);
  domain.inside[0] = domain.inside[1] = 0;  // two cells at the lower left corner
  const SplineLevel level(domain);
  const auto values = corner_samples(level, Eigen::VectorXd::Ones(level.size())).arrays[0].values;
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_TRUE(std::isnan(values[1]));
  EXPECT_DOUBLE_EQ(values[2], 1);
  EXPECT_DOUBLE_EQ(values[9], 1);
}

TEST(CornerSamples, need_a_rectangle_of_equal_cells) {
  VariationalDomain domain = rectangle(1);
  EXPECT_THROW(corner_samples(SplineLevel(domain), Eigen::VectorXd::Ones(3)), InvalidInput);
  domain.y.reset();
  EXPECT_THROW(corner_samples(SplineLevel(domain), Eigen::VectorXd::Ones(9)), InvalidInput);
  domain = {Breakpoints(std::vector<double>{0, 1, 3})};
  domain.y = domain.x;
  EXPECT_THROW(corner_samples(SplineLevel(domain), Eigen::VectorXd::Ones(9)), InvalidInput);
}

}  // namespace
}  // namespace batten
