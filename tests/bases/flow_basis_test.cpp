// SPDX-License-Identifier: MIT
#include <batten/bases/bell_basis.h>
#include <batten/bases/flow_basis.h>
#include <batten/bases/optimal_flow_masks.h>
#include <batten/bases/subdivide_flow.h>
#include <batten/domains/errors.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace batten {
namespace {

constexpr double pi = std::numbers::pi;
using Real = boost::multiprecision::cpp_bin_float_100;

/// (c_y, -c_x) of the five-point Laplacian of the biharmonic Green's function, in 100 digits.
std::array<Real, 2> slow_generator(const Real& x, const Real& y) {
  std::array<Real, 2> sum{0, 0};
  const int stencil[5][3] = {{0, 0, -4}, {1, 0, 1}, {-1, 0, 1}, {0, 1, 1}, {0, -1, 1}};
  for (const auto& [i, j, weight] : stencil) {
    const Real dx = x - i, dy = y - j, rho = dx * dx + dy * dy;
    const Real factor = weight * (log(rho) + 1) / (8 * boost::math::constants::pi<Real>());
    sum[0] += dy * factor;
    sum[1] -= dx * factor;
  }
  return sum;
}

const std::vector<Velocity> places = {{0.3, 0.2},  {-1.25, 0.75}, {2, 1.5},     {0, 2.9},        {3.1, 0},
                                      {-2.5, 1.7}, {-7, 12},      {100, -31.5}, {12345.6, 7890}, {0.01, 2e6}};

TEST(SlowFlowBasis, is_right_to_the_last_digits_at_any_distance) {
  const FlowBasis basis(Flow::Slow);
  for (const auto& [x, y] : places) {
    const auto above = slow_generator(x, Real(y) + 0.5), below = slow_generator(x, Real(y) - 0.5);
    const Velocity found = basis.n_u(x, y);
    const double speed = std::hypot(found[0], found[1]);
    for (std::size_t k : {0, 1}) {
      const Real difference = above[k] - below[k];
      EXPECT_NEAR(found[k], difference.convert_to<double>(), 1e-14 * std::max(speed, 0.1 * (std::hypot(x, y) <= 3)))
          << x << ", " << y;
    }
    const auto exact = slow_generator(x, y);
    const Velocity generated = basis.generator(x, y);
    for (std::size_t k : {0, 1})
      EXPECT_NEAR(generated[k], exact[k].convert_to<double>(),
                  1e-14 * std::hypot(generated[0], generated[1]) + 1e-16 * (std::hypot(x, y) <= 3));
  }
}

TEST(PerfectFlowBasis, is_right_to_the_last_digits_at_any_distance) {
  const FlowBasis basis(Flow::Perfect);
  for (const auto& [x, y] : places) {
    const auto exact = [&](const Real& at) {  // g = (y, -x) / (2π r²)
      const Real rho = 2 * boost::math::constants::pi<Real>() * (Real(x) * x + at * at);
      return std::array<Real, 2>{at / rho, -Real(x) / rho};
    };
    const auto above = exact(Real(y) + 0.5), below = exact(Real(y) - 0.5);
    const Velocity found = basis.n_u(x, y);
    for (std::size_t k : {0, 1}) {
      const Real difference = above[k] - below[k];
      EXPECT_NEAR(found[k], difference.convert_to<double>(), 1e-14 * std::hypot(found[0], found[1])) << x << ", " << y;
    }
  }
  EXPECT_DOUBLE_EQ(basis.n_u(0, 0)[0], 2 / pi);  // between its rotors
  EXPECT_EQ(basis.n_u(0, 0)[1], 0);
}

TEST(FlowBasis, has_n_v_from_the_generator) {  // -g(x + 1/2, y) + g(x - 1/2, y)
  for (Flow flow : {Flow::Perfect, Flow::Slow}) {
    const FlowBasis basis(flow);
    for (const auto& [x, y] : places) {
      if (std::hypot(x, y) > 20) continue;
      const Velocity right = basis.generator(x + 0.5, y), left = basis.generator(x - 0.5, y), found = basis.n_v(x, y);
      for (std::size_t k : {0, 1}) EXPECT_NEAR(found[k], left[k] - right[k], 2e-15);
    }
  }
}

TEST(FlowBasis, has_no_divergence_and_rotates_as_its_law_says) {
  // Perfect flow does not rotate; slow flow by the difference of two harmonic bells, Δ l c_2 = l c_1.
  const double h = 1e-4, x = 0.8, y = 0.35;
  for (Flow flow : {Flow::Perfect, Flow::Slow}) {
    const FlowBasis basis(flow);
    const auto slope = [&](std::size_t component, double dx, double dy) {
      return (basis.n_u(x + dx, y + dy)[component] - basis.n_u(x - dx, y - dy)[component]) / (2 * h);
    };
    EXPECT_NEAR(slope(0, h, 0) + slope(1, 0, h), 0, 1e-6);
    const BellBasis bell(1);
    const double rotation = flow == Flow::Perfect ? 0 : bell.value(x, y + 0.5) - bell.value(x, y - 0.5);
    EXPECT_NEAR(slope(0, 0, h) - slope(1, h, 0), rotation, 1e-6);
  }
}

TEST(FlowBasis, moves_the_middle_of_a_block_as_its_shape_says) {
  // (2/π) atan(K/L). The walls are the midpoint rule for the integral of (L/2) / (π (s² + L²/4)) over -K/2 .. K/2, so
  // perfect flow misses it by at most K max|f''| / 24 = K 2 (2/L)³ / (24 π); slow flow spreads it by a length of 1.
  for (const auto& [k, l] : {std::pair{20, 20}, {40, 20}, {10, 30}})
    for (Flow flow : {Flow::Perfect, Flow::Slow}) {
      const StaggeredField block{Eigen::MatrixXd::Ones(k, l), Eigen::MatrixXd::Zero(k - 1, l + 1)};
      const Velocity found = flow_at(FlowBasis(flow), block, (k - 1) / 2., l / 2.);
      const double bound = k * 2 * std::pow(2. / l, 3) / (24 * pi);
      EXPECT_NEAR(found[0], 2 / pi * std::atan(static_cast<double>(k) / l), flow == Flow::Perfect ? bound : 2 * bound);
      EXPECT_NEAR(found[1], 0, 1e-14);
    }
}

TEST(FlowAt, places_walls_in_units_of_the_spacing) {
  StaggeredField field{Eigen::MatrixXd::Zero(4, 3), Eigen::MatrixXd::Zero(3, 4), {10, -4}, 0.25};
  field.u(2, 1) = 3;   // at (10.5, -3.625)
  field.v(0, 3) = -2;  // at (10.125, -3.25)
  for (Flow flow : {Flow::Perfect, Flow::Slow}) {
    const FlowBasis basis(flow);
    const Velocity found = flow_at(basis, field, 10.4, -3.5);
    const Velocity u = basis.n_u(-0.4, 0.5), v = basis.n_v(1.1, -1);
    for (std::size_t k : {0, 1}) EXPECT_NEAR(found[k], 3 * u[k] - 2 * v[k], 1e-12);
  }
}

/// Largest |u - n_u| of the exact scheme on level k over walls with 1 <= x, y <= 2.
double exact_error(Flow flow, int k) {
  const FlowBasis basis(flow);
  const int n = 1 << k;
  const auto u = exact_flow_rounds(flow, k, {{n, n}, {2 * n, 2 * n}});
  double error = 0;
  for (const Index<2>& i : indices_of<2>({{n, n}, {2 * n, 2 * n}})) {
    const double x = static_cast<double>(i[0]) / n, y = (i[1] + 0.5) / n;
    error = std::max(error, std::abs(u[i] - basis.n_u(x, y)[0]));
  }
  return error;
}

TEST(ExactFlowScheme, tends_to_the_analytic_basis_by_order_two) {
  for (Flow flow : {Flow::Perfect, Flow::Slow}) {
    const int k = flow == Flow::Perfect ? 3 : 2;  // slow flow is there sooner, and takes longer
    const double order = std::log2(exact_error(flow, k) / exact_error(flow, k + 1));
    RecordProperty(flow == Flow::Perfect ? "order_perfect" : "order_slow", std::to_string(order));
    EXPECT_NEAR(order, 2, 0.3);
  }
}

/// Largest difference on level 4 from the analytic flow of a rotor: four unit walls around a vertex, a field without
/// divergence. Only walls that are 0.3 or more from vertices count, where perfect flow is infinite.
double rotor_error(Flow flow, FlowKind kind, int size) {
  StaggeredField rotor{Eigen::MatrixXd::Zero(5, 4), Eigen::MatrixXd::Zero(4, 5), {-2, -2}};
  rotor.u(2, 1) = rotor.v(2, 2) = 1;
  rotor.u(2, 2) = rotor.v(1, 2) = -1;
  const auto masks = to_double(optimal_flow_masks(flow, kind, size).masks);
  const StaggeredField fine = subdivided(masks, rotor, {.levels = 4, .sides = FieldSides::Zero});
  const FlowBasis basis(flow);
  double error = 0;
  for (int j = 0; j < fine.u.cols(); ++j)
    for (int i = 0; i < fine.u.rows(); ++i) {
      const double x = fine.start[0] + i * fine.spacing, y = fine.start[1] + (j + 0.5) * fine.spacing;
      if (std::max(std::abs(x), std::abs(y)) > 2 || std::hypot(x - std::round(x), y - std::round(y)) < 0.3) continue;
      error = std::max(error, std::abs(fine.u(i, j) - flow_at(basis, rotor, x, y)[0]));
    }
  return error;
}

TEST(FiniteFlowSchemes, come_nearer_to_the_analytic_basis_with_their_size) {
  // speeds are about 1/2; the error of level 4 itself is one or two hundredths
  EXPECT_LT(rotor_error(Flow::Slow, FlowKind::Book, 13), 0.5 * rotor_error(Flow::Slow, FlowKind::Book, 5));
  EXPECT_LT(rotor_error(Flow::Slow, FlowKind::Commuting, 13), 0.2 * rotor_error(Flow::Slow, FlowKind::Commuting, 5));
  EXPECT_LT(rotor_error(Flow::Perfect, FlowKind::Commuting, 13),
            0.25 * rotor_error(Flow::Perfect, FlowKind::Commuting, 5));
  EXPECT_LT(rotor_error(Flow::Slow, FlowKind::Commuting, 17), 0.01);
}

}  // namespace
}  // namespace batten
