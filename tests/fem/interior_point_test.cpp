// SPDX-License-Identifier: MIT
#include <batten/fem/balls.h>
#include <batten/fem/boxes.h>
#include <batten/fem/dense_energy.h>
#include <batten/fem/interior_point.h>

#include "../support/observations.h"
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace batten {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  test::Random random(seed);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random.normal(); });
}

/// ½ |c|² - q·c with some random rows, and everything that is needed to judge a result by hand.
struct Problem {
  Problem(Eigen::Index unknowns, Eigen::Index row_count, unsigned seed)
      : q(2 * random_matrix(unknowns, 1, seed)), rows(random_matrix(row_count, unknowns, seed + 1000)) {}
  DenseEnergy energy() const { return {Eigen::MatrixXd::Identity(q.size(), q.size()), q, rows}; }
  double value(const Eigen::VectorXd& c) const { return c.squaredNorm() / 2 - q.dot(c); }
  /// min over all c of ½ |c|² - q·c - f·B c
  double bound(std::span<const double> force) const {
    const Eigen::Map<const Eigen::VectorXd> f(force.data(), rows.rows());
    return -(q + rows.transpose() * f).squaredNorm() / 2;
  }

  Eigen::VectorXd q;
  Eigen::MatrixXd rows;
};

TEST(InteriorPoint, ends_within_its_gap_of_the_least_energy_in_boxes) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Problem problem(8, 30, seed);
    test::Random random(seed);
    const Eigen::VectorXd inside = problem.rows * random_matrix(8, 1, seed + 1);  // so that the set is not empty
    std::vector<double> lower, upper, unit;
    for (Eigen::Index i = 0; i < 30; ++i) {
      unit.push_back(0.1 + random());
      lower.push_back(i % 5 == 0 ? -infinity : inside[i] - unit.back());
      upper.push_back(i % 5 == 1 ? infinity : inside[i] + unit.back() * random());
    }
    DenseEnergy energy = problem.energy();
    Boxes boxes(lower, upper, unit);
    boxes.start(energy.values(), 1);
    const auto result = minimise(energy, boxes, {.gap = 1e-6, .least_energy = 1});
    ASSERT_TRUE(result.converged) << seed;
    EXPECT_LE(result.steps, 25) << seed;
    const Eigen::VectorXd v = problem.rows * energy.coefficients();
    double gain = 0;
    for (Eigen::Index i = 0; i < 30; ++i) {
      const auto k = static_cast<std::size_t>(i);
      EXPECT_LE(v[i], upper[k]);
      EXPECT_GE(v[i], lower[k]);
      const double f = result.force[k];
      if (f != 0) gain -= f * (f > 0 ? lower[k] : upper[k]);
    }
    // margins are a share of the width: they cost what the forces do along them
    const double value = problem.value(energy.coefficients()), bound = problem.bound(result.force) - gain;
    EXPECT_LE(value - bound, 1e-6 * std::max(1., value) + 1e-12) << seed;
  }
}

TEST(InteriorPoint, ends_within_its_gap_of_the_least_energy_in_balls) {
  for (int dimension : {1, 2, 3})
    for (unsigned seed = 1; seed <= 40; ++seed) {
      constexpr Eigen::Index blocks = 12;
      const Problem problem(9, dimension * blocks, seed);
      test::Random random(seed);
      const Eigen::VectorXd inside = problem.rows * random_matrix(9, 1, seed + 1);
      std::vector<double> centre, radius;
      for (Eigen::Index i = 0; i < blocks; ++i) {
        double square = 0;
        for (Eigen::Index k = 0; k < dimension; ++k) {
          const double away = random() - 0.5;
          centre.push_back(inside[i * dimension + k] + away);
          square += away * away;
        }
        radius.push_back(std::sqrt(square) + 0.3 * random());
      }
      DenseEnergy energy = problem.energy();
      Balls balls(centre, radius, {.dimension = dimension});
      balls.start(energy.values(), 1);
      const auto result = minimise(energy, balls, {.gap = 1e-6, .least_energy = 1});
      ASSERT_TRUE(result.converged) << dimension << " " << seed;
      EXPECT_LE(result.steps, 25) << dimension << " " << seed;
      const Eigen::VectorXd v = problem.rows * energy.coefficients();
      const Eigen::Map<const Eigen::VectorXd> f(result.force.data(), v.size());
      const Eigen::Map<const Eigen::VectorXd> c(centre.data(), v.size());
      double gain = -f.dot(c);
      for (Eigen::Index i = 0; i < blocks; ++i) {
        const Eigen::Index at = i * dimension;
        EXPECT_LE((v - c).segment(at, dimension).norm(), radius[static_cast<std::size_t>(i)]);
        gain += radius[static_cast<std::size_t>(i)] * f.segment(at, dimension).norm();
      }
      const double value = problem.value(energy.coefficients());
      EXPECT_LE(value - (problem.bound(result.force) - gain), 1e-6 * std::max(1., value) + 1e-12) << seed;
    }
}

// The point of a disc that is nearest to q, and of the meeting of two discs: corners and arcs.
TEST(InteriorPoint, finds_the_nearest_point_of_discs) {
  Eigen::MatrixXd rows(4, 2);
  rows << 1, 0, 0, 1, 1, 0, 0, 1;
  const auto nearest = [&](double x, double y) {
    DenseEnergy energy(Eigen::Matrix2d::Identity(), Eigen::Vector2d(x, y), rows);
    Balls balls({0, 0, 1, 0}, {1, 1}, {.dimension = 2});
    balls.start(energy.values(), 1);
    EXPECT_TRUE(minimise(energy, balls, {.gap = 1e-7, .least_energy = 1}).converged);
    return Eigen::Vector2d(energy.coefficients());
  };
  const auto expect = [&](double x, double y, double a, double b) {
    EXPECT_LT((nearest(x, y) - Eigen::Vector2d(a, b)).norm(), 1e-3) << x << " " << y;
  };
  expect(3, 0, 1, 0);
  expect(0.5, 7, 0.5, std::sqrt(0.75));
  expect(0.4, 0.2, 0.4, 0.2);
  expect(2, 0.5, 2 / std::hypot(2, 0.5), 0.5 / std::hypot(2, 0.5));
}

TEST(InteriorPoint, of_elastic_balls_finds_the_least_radius) {
  for (int dimension : {1, 2, 3}) {
    // points whose smallest enclosing ball has radius 1 more than the 0.5 that they have: θ = 0.5
    const Eigen::Index rows = dimension + 1;
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(2 * rows, dimension + 1);
    std::vector<double> centre(static_cast<std::size_t>(2 * dimension));
    centre[0] = 3;
    centre[static_cast<std::size_t>(dimension)] = 5;
    for (Eigen::Index i = 0; i < 2; ++i) {
      b(i * rows, dimension) = 1;
      for (Eigen::Index k = 0; k < dimension; ++k) b(i * rows + 1 + k, k) = 1;
    }
    DenseEnergy energy(1e-9 * Eigen::MatrixXd::Identity(dimension + 1, dimension + 1),
                       -Eigen::VectorXd::Unit(dimension + 1, dimension), b);
    Balls balls(centre, {0.5, 0.5}, {.dimension = dimension, .is_elastic = true});
    balls.start(energy.values(), 1);
    EXPECT_TRUE(minimise(energy, balls, {.gap = 1e-6, .least_energy = 1}).converged);
    EXPECT_NEAR(energy.coefficients()[dimension], 0.5, 1e-4);
    EXPECT_NEAR(energy.coefficients()[0], 4, 1e-4);
  }
}

TEST(InteriorPoint, says_that_an_empty_set_has_no_least_energy) {
  Eigen::MatrixXd rows(2, 1);
  rows << 1, 1;
  DenseEnergy energy(Eigen::MatrixXd::Identity(1, 1), Eigen::VectorXd::Zero(1), rows);
  Boxes boxes({0, 2}, {1, 3}, {1, 1});
  boxes.start(energy.values(), 1);
  const auto result = minimise(energy, boxes, {});
  EXPECT_FALSE(result.converged);
  EXPECT_GT(result.violation, 0.1);
}

}  // namespace
}  // namespace batten
