// SPDX-License-Identifier: MIT
#include <batten/bases/flow_limit.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double pi = std::numbers::pi;

/// 4 x 3 cells from (10, -4), spacing 1/4.
StaggeredField random_field() {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto next = [&] { return number(random); };
  return {Eigen::MatrixXd::NullaryExpr(5, 3, next), Eigen::MatrixXd::NullaryExpr(4, 4, next), {10, -4}, 0.25};
}

bool is_coarse(Eigen::Index i, int levels) { return i % (Eigen::Index{1} << levels) == 0; }

TEST(FlowLimit, is_the_sum_of_the_basis_functions) {
  const StaggeredField field = random_field();
  const int levels = 2;
  for (Flow flow : {Flow::Perfect, Flow::Slow}) {
    const FlowBasis basis(flow);
    const ControlGrid limit = flow_limit(basis, field, levels);
    const Eigen::MatrixXd &u = limit.components.at(0), &v = limit.components.at(1);
    ASSERT_EQ(u.rows(), 17);
    ASSERT_EQ(v.cols(), 13);
    EXPECT_EQ(limit.start, field.start);
    EXPECT_EQ(limit.spacing, (std::array<double, 2>{1. / 16, 1. / 16}));
    for (Eigen::Index j = 0; j < u.cols(); ++j)
      for (Eigen::Index i = 0; i < u.rows(); ++i) {
        const bool is_infinite = flow == Flow::Perfect && is_coarse(i, levels) && is_coarse(j, levels);
        EXPECT_EQ(std::isnan(u(i, j)), is_infinite);
        EXPECT_EQ(std::isnan(v(i, j)), is_infinite);
        if (is_infinite) continue;
        const Velocity sum = flow_at(basis, field, 10 + static_cast<double>(i) / 16, -4 + static_cast<double>(j) / 16);
        EXPECT_NEAR(u(i, j), sum[0], 1e-13);
        EXPECT_NEAR(v(i, j), sum[1], 1e-13);
      }
  }
}

TEST(FlowLimit, is_finite_where_rotors_of_neighbours_cancel) {
  // Within a block of u = 0.3 (no number of finite binary digits) nothing rotates, and perfect flow is harmonic there:
  // the value at a vertex is the mean over a circle, by the trapezoidal rule with an error of about (1/4)^16.
  StaggeredField block{Eigen::MatrixXd::Constant(5, 4, 0.1), Eigen::MatrixXd::Zero(4, 5)};
  block.u *= 3;
  block.u.col(1) = Eigen::VectorXd::Constant(5, 0.3);  // rounded in another way
  const FlowBasis basis(Flow::Perfect);
  const ControlGrid limit = flow_limit(basis, block, 0);
  Velocity mean{0, 0};
  for (int k = 0; k < 16; ++k) {
    const double angle = 2 * pi * (k + 0.5) / 16;
    const Velocity at = flow_at(basis, block, 2 + 0.25 * std::cos(angle), 2 + 0.25 * std::sin(angle));
    for (std::size_t c : {0, 1}) mean[c] += at[c] / 16;
  }
  EXPECT_NEAR(limit.components[0](2, 2), mean[0], 1e-9);
  EXPECT_NEAR(limit.components[1](2, 2), mean[1], 1e-9);
  EXPECT_TRUE(std::isnan(limit.components[0](2, 0)));
}

TEST(FlowOfRotors, is_the_generator_at_one) {
  ControlGrid rotation{.components = {Eigen::MatrixXd::Zero(3, 3)}, .start = {-2, -2}, .spacing = {2, 2}};
  rotation.components[0](1, 1) = 0.5;  // times the spacing: 1
  const ControlGrid perfect = flow_of_rotors(FlowBasis(Flow::Perfect), rotation, 1);
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i) {
      const double x = (i - 2) / 2., y = (j - 2) / 2., rho = x * x + y * y;
      if (rho == 0) continue;
      EXPECT_NEAR(perfect.components[0](i, j), y / (2 * pi * rho), 1e-15);
      EXPECT_NEAR(perfect.components[1](i, j), -x / (2 * pi * rho), 1e-15);
    }
  EXPECT_TRUE(std::isnan(perfect.components[0](2, 2)));
  const ControlGrid slow = flow_of_rotors(FlowBasis(Flow::Slow), rotation, 1);
  EXPECT_EQ(slow.components[0](2, 2), 0);
  EXPECT_EQ(slow.components[1](2, 2), 0);
  EXPECT_GT(slow.components[0](2, 3), 0);  // clockwise
  EXPECT_LT(slow.components[1](3, 2), 0);
}

TEST(FlowOfRotors, needs_a_grid) {
  const FlowBasis basis(Flow::Slow);
  const auto expect = [&](const ControlGrid& rotation, int levels, const char* text) {
    EXPECT_THAT([&] { flow_of_rotors(basis, rotation, levels); }, ThrowsMessage<InvalidInput>(HasSubstr(text)));
  };
  ControlGrid rotation{.components = {Eigen::MatrixXd::Zero(3, 3)}};
  expect(rotation, -1, "levels must not be negative, found -1");
  expect(rotation, 14, "more than 2^28 vertices, on level 14");
  rotation.spacing[1] = 2;
  expect(rotation, 1, "cells must be square, found the spacing 1 in x and 2 in y");
  rotation = {.components = {Eigen::MatrixXd::Constant(3, 3, NAN)}};
  expect(rotation, 1, "rotation must be finite");
  expect({.components = {Eigen::MatrixXd::Zero(3, 1)}}, 1, "2 x 2 vertices or more are needed, found 3 x 1");
  expect({.components = {}}, 1, "one component is needed, found 0");
}

}  // namespace
}  // namespace batten
