// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/curve_fit.h>
#include <batten/fem/curve_within.h>

#include "../support/observations.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numeric>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

struct Case {
  std::vector<double> knots, tolerances;
  Eigen::MatrixXd points;
  CurveWithinOptions options;
};

/// Waves with noise; seeds differ in everything.
Case random_case(unsigned seed, int least, int most) {
  test::Random random(seed);
  Case c;
  const int n = least + static_cast<int>((most - least + 1) * random() * random());
  const int dimension = 1 + static_cast<int>(3 * random());
  c.options.closed = random() < 0.4;
  const double noise = std::pow(10., -3 * random()), uneven = random() < 0.4 ? 0 : 0.98;
  const double width = noise * 0.2 * std::pow(25., random()), waves = 1 + std::floor(8 * random());
  c.knots = {3};
  for (int i = 0; i + (c.options.closed ? 0 : 1) < n; ++i) c.knots.push_back(c.knots.back() + 1 - uneven * random());
  c.points.resize(n, dimension);
  for (int i = 0; i < n; ++i) {
    const double t = (c.knots[static_cast<std::size_t>(i)] - 3) / (c.knots.back() - 3);
    for (int k = 0; k < dimension; ++k)
      c.points(i, k) = std::sin(6.283185307 * waves * t + k) + noise * random.normal();
    c.tolerances.push_back(seed % 3 ? width : width * (0.3 + random()));
  }
  return c;
}

CurveWithin within(const Case& c) { return least_curve_within(c.knots, c.points, c.tolerances, c.options); }

/// max over i of |p(t_i) - b_i| / tolerance_i
double worst_miss(const Case& c, const NaturalCubic& curve) {
  const Eigen::VectorXd misses = (curve.values() - c.points).rowwise().norm();
  double worst = 0;
  for (std::size_t i = 0; i < c.tolerances.size(); ++i)
    worst = std::max(worst, misses[static_cast<Eigen::Index>(i)] / c.tolerances[i]);
  return worst;
}

/// No curve within the tolerances has less ∫ |p''|²: forces F of any spline q do work F·p = ∫ p''·q'' on any curve p,
/// so that ∫ |p''|² >= 2 F·p - ∫ |q''|² >= 2 Σ_i (F_i·b_i - |F_i| tolerance_i) - ∫ |q''|². Here q is the result.
double bound_by_forces(const Case& c, const NaturalCubic& curve) {
  const Eigen::MatrixXd forces = curve.forces();
  double sum = -curve.energy();
  for (Eigen::Index i = 0; i < forces.rows(); ++i)
    sum += 2 * (forces.row(i).dot(c.points.row(i)) - forces.row(i).norm() * c.tolerances[static_cast<std::size_t>(i)]);
  return sum;
}

double cube_of_length(const Case& c) { return std::pow(c.knots.back() - c.knots.front(), 3); }

double range_of(const Case& c) { return (c.points.colwise().maxCoeff() - c.points.colwise().minCoeff()).maxCoeff(); }

void expect_least(const Case& c, const CurveWithin& result) {
  EXPECT_LE(worst_miss(c, result.curve), 1);
  EXPECT_EQ(result.account.largest_violation, 0);
  EXPECT_LE(result.account.energy_gap, 1e-3);
  EXPECT_LE(result.account.factorisations, 60);
  const double energy = result.curve.energy() * cube_of_length(c);
  const double least = 1e-8 * range_of(c) * range_of(c);
  EXPECT_NEAR(energy, result.account.energy, 1e-9 * energy + 1e-3 * least);
  const double bound = bound_by_forces(c, result.curve) * cube_of_length(c);
  EXPECT_LE(energy - std::max(bound, 0.), 1.001e-3 * std::max(energy, least));  // no energy is negative
}

TEST(CurveWithin, never_fails_and_is_proved_to_be_least_by_its_own_forces) {
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    SCOPED_TRACE(seed);
    const Case c = random_case(seed, 5, 400);
    expect_least(c, within(c));
    if (HasFailure()) return;
  }
}

/// ½ p·K p = ½ ∫ |p''|² of splines with values p, by the forces of one value after the other.
Eigen::MatrixXd stiffness(const Case& c) {
  const Eigen::Index n = c.points.rows();
  return interpolating_curve(c.knots, Eigen::MatrixXd::Identity(n, n), c.options.closed).forces();
}

/// The least ∫ |p''|² by another method: each point in turn to where its ball lets the energy be least, over and over.
/// Of one component, where that point is at hand.
double energy_by_coordinates(const Case& c) {
  const Eigen::MatrixXd k = stiffness(c);
  Eigen::VectorXd p = c.points.col(0), force = k * p;
  for (int sweep = 0; sweep < 200'000; ++sweep) {
    double moved = 0;
    for (Eigen::Index i = 0; i < p.size(); ++i) {
      const double tolerance = c.tolerances[static_cast<std::size_t>(i)], b = c.points(i, 0);
      const double change = std::clamp(p[i] - force[i] / k(i, i), b - tolerance, b + tolerance) - p[i];
      p[i] += change;
      force += change * k.col(i);
      moved = std::max(moved, std::abs(change) / tolerance);
    }
    if (moved < 1e-10) break;
  }
  return p.dot(k * p);
}

TEST(CurveWithin, has_the_energy_that_descent_by_coordinates_ends_at) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Case c = random_case(seed, 5, 12);
    c.points = c.points.col(0).eval();
    const double expected = energy_by_coordinates(c), found = within(c).curve.energy();
    const double least = 1e-8 * range_of(c) * range_of(c) / cube_of_length(c);
    EXPECT_GT(found, expected - 1e-6 * expected - 1e-3 * least) << seed;
    EXPECT_LT(found, expected + 1e-3 * std::max(expected, least)) << seed;
  }
}

TEST(CurveWithin, is_found_where_changing_weights_did_not_end) {
  const std::vector<double> f = {.4, -.1, .8, .8, .9, .8, .1, .1, -.5, 0, -.9, -1.1, -1, -.8, -.5};
  Case c{std::vector<double>(f.size()), {}, Eigen::Map<const Eigen::VectorXd>(f.data(), 15), {}};
  std::iota(c.knots.begin(), c.knots.end(), 0);
  for (const double tolerance : {.25, .3, .35, .4, .5}) {
    c.tolerances.assign(f.size(), tolerance);
    expect_least(c, within(c));
  }
  test::Random random(1);
  Case wave{std::vector<double>(400), std::vector<double>(400, 0.2), Eigen::MatrixXd(400, 1), {}};
  for (Eigen::Index i = 0; i < 400; ++i) {
    wave.knots[static_cast<std::size_t>(i)] = static_cast<double>(i) / 399;
    wave.points(i, 0) = std::sin(6 * static_cast<double>(i) / 399) + 0.1 * random.normal();
  }
  expect_least(wave, within(wave));
}

// Points 0.99 √dimension beside a line (closed: a point), tolerances √dimension.
TEST(CurveWithin, is_straight_where_a_line_is_near_enough) {
  for (const bool closed : {false, true}) {
    Case c = random_case(3, 50, 50);
    c.options.closed = closed;
    if (closed == (c.knots.size() == 50)) closed ? c.knots.push_back(c.knots.back() + 1) : c.knots.pop_back();
    for (Eigen::Index i = 0; i < c.points.rows(); ++i)
      c.points.row(i).setConstant(7 + (closed ? 0 : 2 * c.knots[static_cast<std::size_t>(i)]) + (i % 2 ? 0.99 : -0.99));
    c.tolerances.assign(50, std::sqrt(static_cast<double>(c.points.cols())));
    const auto result = within(c);
    EXPECT_EQ(result.account.energy, 0);
    EXPECT_EQ(result.account.factorisations, 0);
    EXPECT_LE(worst_miss(c, result.curve), 1);
    EXPECT_LT(result.curve.energy() * cube_of_length(c), 1e-12);
  }
}

// A line of regression that misses, beside another that does not: 0 is within 1 of -1, 1, ..., but for the last that
// lies at 9 with a tolerance of 10, which draws the regression up.
TEST(CurveWithin, finds_lines_other_than_that_of_regression) {
  Case c{{}, {}, Eigen::MatrixXd(40, 1), {}};
  for (int i = 0; i < 40; ++i) {
    c.knots.push_back(i);
    c.points(i, 0) = i == 39 ? 9 : i % 2 ? 0.9 : -0.9;
    c.tolerances.push_back(i == 39 ? 10 : 0.95);
  }
  EXPECT_EQ(within(c).account.energy, 0);
}

// Three points at t = 0, 1, 2 with p = 0, 1, 0: only the second difference d bends, ∫ |p''|² = 3/2 d² of unit cells.
// Tolerance e: d = 2 - 4e, held at all three, and the parameter from 0 to 1 makes that 8 times as much.
TEST(CurveWithin, of_three_points_has_the_energy_by_hand) {
  Case c{{5, 6, 7}, {0.1, 0.1, 0.1}, Eigen::Vector3d(0, 1, 0), {}};
  const auto result = within(c);
  EXPECT_NEAR(result.account.energy, 8 * 1.5 * 1.6 * 1.6, 1e-3 * 8 * 1.5 * 1.6 * 1.6);
  EXPECT_EQ(result.account.active, 3);
}

TEST(CurveWithin, has_the_same_bits_for_every_number_of_threads) {
  test::Random random(2);
  const int n = 20'000;  // several blocks
  for (const int dimension : {1, 2}) {
    Case c{{}, std::vector<double>(n, 0.1), Eigen::MatrixXd(n, dimension), {}};
    for (int i = 0; i < n; ++i) c.knots.push_back(i + 0.5 * random());
    c.points = Eigen::MatrixXd::NullaryExpr(n, dimension, [&] { return 0.05 * random.normal(); });
    c.points.col(0) += Eigen::VectorXd::LinSpaced(n, 0, 20).array().sin().matrix();
    const int before = omp_get_max_threads();
    omp_set_num_threads(1);
    const Eigen::MatrixXd one = within(c).curve.coefficients();
    omp_set_num_threads(3);
    EXPECT_EQ(within(c).curve.coefficients(), one);
    omp_set_num_threads(before);
  }
}

TEST(CurveWithin, says_what_is_wrong_with_tolerances) {
  Case c{{0, 1, 2}, {1, 0, 1}, Eigen::Vector3d(0, 1, 0), {}};
  EXPECT_THAT([&] { within(c); },
              ThrowsMessage<InvalidInput>(HasSubstr("tolerances must be positive, found 0.000000 at place 1")));
  c.tolerances = {1, 1};
  EXPECT_THAT([&] { within(c); }, ThrowsMessage<InvalidInput>(HasSubstr("one tolerance for each of 3 points")));
  c.tolerances = {1, 1, 1};
  c.points = Eigen::MatrixXd::Zero(3, 4);
  EXPECT_THAT([&] { within(c); }, ThrowsMessage<InvalidInput>(HasSubstr("dimension 1 to 3 are expected, found 4")));
}

}  // namespace
}  // namespace batten
