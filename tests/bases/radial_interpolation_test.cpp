// SPDX-License-Identifier: MIT
#include <batten/bases/bell_basis.h>
#include <batten/bases/radial_interpolation.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Eigen::MatrixX2d scattered_points(int n) {
  std::mt19937_64 random(5);
  Eigen::MatrixX2d points(n, 2);
  for (double& x : points.reshaped()) x = static_cast<double>(random() >> 11) * 0x1p-53;
  return points;
}

/// All points of Z² with |x|, |y| <= reach.
Eigen::MatrixX2d grid_points(int reach) {
  const int row = 2 * reach + 1;
  Eigen::MatrixX2d points(row * row, 2);
  for (int k = 0; k < row * row; ++k) points.row(k) << k % row - reach, k / row - reach;
  return points;
}

template <class Function>
Eigen::VectorXd sampled(const Eigen::MatrixX2d& points, Function&& f) {
  Eigen::VectorXd values(points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) values[i] = f(points(i, 0), points(i, 1));
  return values;
}

TEST(ThinPlateInterpolant, meets_the_values) {
  const auto points = scattered_points(60);
  const auto values = sampled(points, [](double x, double y) { return std::sin(7 * x) * std::cos(5 * y); });
  const ThinPlateInterpolant p(points, values);
  for (Eigen::Index i = 0; i < values.size(); ++i) EXPECT_NEAR(p.value(points(i, 0), points(i, 1)), values[i], 1e-10);
}

TEST(ThinPlateInterpolant, keeps_linear_functions) {
  const auto points = scattered_points(20);
  const auto f = [](double x, double y) { return 3 - 2 * x + 5 * y; };
  const ThinPlateInterpolant p(points, sampled(points, f));
  EXPECT_LT(p.weights().cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_NEAR(p.value(2, -3), f(2, -3), 1e-10);
  EXPECT_NEAR(p.gradient(2, -3)[0], -2, 1e-10);
  EXPECT_NEAR(p.gradient(2, -3)[1], 5, 1e-10);
}

TEST(ThinPlateInterpolant, weights_satisfy_the_side_conditions) {
  const auto points = scattered_points(40);
  const ThinPlateInterpolant p(points, sampled(points, [](double x, double y) { return std::exp(x * y); }));
  const Eigen::VectorXd a = p.weights();
  const double tolerance = 1e-12 * a.cwiseAbs().sum();
  EXPECT_NEAR(a.sum(), 0, tolerance);
  EXPECT_NEAR(a.dot(points.col(0)), 0, tolerance);
  EXPECT_NEAR(a.dot(points.col(1)), 0, tolerance);
}

TEST(ThinPlateInterpolant, of_a_bell_on_a_grid_is_the_bell_everywhere) {
  // n = Σ l²[i] c(x - i) is of the interpolant's form, and l² annihilates linear polynomials
  const BellBasis bell(2);
  const auto points = grid_points(3);
  const ThinPlateInterpolant p(points, sampled(points, [&](double x, double y) { return bell.value(x, y); }));
  EXPECT_NEAR(p.weights()[24], 20, 1e-11);
  EXPECT_NEAR(p.weights()[25], -8, 1e-11);
  EXPECT_NEAR(p.weights()[0], 0, 1e-11);
  for (auto [x, y] : {std::pair(0.3, 0.4), {-1.7, 2.2}, {5., 0.5}, {20., -11.}}) {
    EXPECT_NEAR(p.value(x, y), bell.value(x, y), 1e-11);
    EXPECT_NEAR(p.gradient(x, y)[0], bell.gradient(x, y)[0], 1e-11);
    EXPECT_NEAR(p.gradient(x, y)[1], bell.gradient(x, y)[1], 1e-11);
  }
}

TEST(ThinPlateInterpolant, does_not_depend_on_the_unit_of_length) {
  const auto points = scattered_points(30);
  const auto values = sampled(points, [](double x, double y) { return x * x - y * y * y; });
  const Eigen::MatrixX2d moved = (1e4 * points).rowwise() + Eigen::RowVector2d(3e5, -2e5);
  const ThinPlateInterpolant p(points, values), q(moved, values);
  EXPECT_NEAR(p.value(0.4, 0.7), q.value(1e4 * 0.4 + 3e5, 1e4 * 0.7 - 2e5), 1e-9);
  EXPECT_NEAR(p.weights()[3], 1e8 * q.weights()[3], 1e-6 * std::abs(p.weights()[3]));
}

TEST(ThinPlateInterpolant, refuses_data_that_determine_no_plate) {
  Eigen::MatrixX2d points(4, 2);
  points << 0, 0, 1, 1, 2, 2, 3, 3;
  Eigen::VectorXd values = Eigen::VectorXd::Ones(4);
  EXPECT_THAT([&] { ThinPlateInterpolant(points, values); }, ThrowsMessage<InvalidInput>(HasSubstr("on a line")));
  EXPECT_THAT([&] { ThinPlateInterpolant(points, values.head(3)); },
              ThrowsMessage<InvalidInput>(HasSubstr("4 points and 3 values")));
  EXPECT_THAT([&] { ThinPlateInterpolant(points.topRows(2), values.head(2)); },
              ThrowsMessage<InvalidInput>(HasSubstr("at least 3 points are needed, found 2")));
  points.row(3) = points.row(1);
  EXPECT_THAT([&] { ThinPlateInterpolant(points, values); },
              ThrowsMessage<InvalidInput>(HasSubstr("points 1 and 3 are the same")));
  values[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { ThinPlateInterpolant(points, values); }, ThrowsMessage<InvalidInput>(HasSubstr("must be finite")));
}

}  // namespace
}  // namespace batten
