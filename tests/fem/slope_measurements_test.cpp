// SPDX-License-Identifier: MIT
#include <batten/fem/difference_form.h>
#include <batten/fem/fit_problem.h>
#include <batten/fem/null_space.h>

#include "../support/laws.h"
#include "../support/observations.h"
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

const Rectangle wide = {Interval(-1, 3, 23), Interval(2, 4, 17)};  // longer side 4

/// Random points with a value, a slope in x and one in y each, ordered by cells.
GridPoints measurements(const SplineSpace& space, std::size_t count) {
  test::Random random(7);
  GridPoints all;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random() * space.x.interval().finest_cells(), y = random() * space.y.interval().finest_cells();
    for (const Measured kind : {Measured::Value, Measured::SlopeX, Measured::SlopeY}) {
      all.x.push_back(x);
      all.y.push_back(y);
      all.kind.push_back(kind);
    }
  }
  const auto order = cell_order(all, space);
  return {reordered(all.x, order), reordered(all.y, order), reordered(all.kind, order)};
}

TEST(SlopeMeasurements, of_a_quadratic_function_are_its_derivatives_in_normalised_coordinates) {
  for (const int degree : {3, 4, 5}) {
    const Hierarchy h(Energy::third_derivatives(), wide, degree);
    const QuadraticFunction q{{0.5, -1, 2, 3, -4, 1.5}, 0.7, 2.9, 4};
    const auto points = measurements(h.finest().space, 40);
    for (int k = 0; k < h.size(); ++k) {
      const auto& space = h[k].space;
      std::vector<double> c(space.size()), found(points.size());
      q.add_to(space, c);
      DataTerm(space, points).values(c, found);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double x = -1 + 4 * points.x[i] / 23, y = 2 + 2 * points.y[i] / 17, s = (x - 0.7) / 4, t = (y - 2.9) / 4;
        const double expected = points.kind[i] == Measured::Value    ? q(x, y)
                                : points.kind[i] == Measured::SlopeX ? -1 + 6 * s - 4 * t
                                                                     : 2 - 4 * s + 3 * t;
        ASSERT_NEAR(found[i], expected, 1e-13) << "level " << k;
      }
    }
  }
}

/// B, one row for each measurement, from the spline basis alone.
Eigen::MatrixXd dense_rows(const SplineSpace& space, const GridPoints& points) {
  Eigen::MatrixXd b =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(points.size()), static_cast<Eigen::Index>(space.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool sx = points.kind[i] == Measured::SlopeX, sy = points.kind[i] == Measured::SlopeY;
    const auto x = space.x.at(points.x[i], sx), y = space.y.at(points.y[i], sy);
    for (int q = 0; q <= space.y.degree(); ++q)
      for (int p = 0; p <= space.x.degree(); ++p)
        b(static_cast<Eigen::Index>(i), (y.first + q) * space.x.size() + x.first + p) =
            x.values[static_cast<std::size_t>(p)] * y.values[static_cast<std::size_t>(q)] /
            ((sx ? space.hx : 1) * (sy ? space.hy : 1));
  }
  return b;
}

TEST(SlopeMeasurements, give_the_normal_matrix_in_both_forms_and_a_lumped_one_above_it) {
  const Hierarchy h(Energy::thin_plate(), wide, 3);
  const auto points = measurements(h.finest().space, 60);
  std::vector<double> weights = test::random_vector(points.size(), 2);
  for (double& w : weights) w = 1.1 + w;
  for (int k = 0; k < h.size(); ++k) {
    const auto& space = h[k].space;
    const Eigen::MatrixXd b = dense_rows(space, points);
    const Eigen::MatrixXd normal =
        b.transpose() * Eigen::Map<const Eigen::VectorXd>(weights.data(), b.rows()).asDiagonal() * b;
    const auto c = test::random_vector(space.size(), 5);
    const Eigen::VectorXd expected = normal * Eigen::Map<const Eigen::VectorXd>(c.data(), normal.rows());
    for (const bool stored : {false, true}) {
      DataTerm term(space, points, stored);
      term.set_weights(weights);
      std::vector<double> found(space.size());
      term.add_normal(1, c, found);
      for (std::size_t i = 0; i < found.size(); ++i)
        ASSERT_NEAR(found[i], expected[static_cast<Eigen::Index>(i)], 1e-13 * normal.cwiseAbs().maxCoeff());
      const auto lumped = term.lumped();
      const Eigen::MatrixXd rest =
          Eigen::MatrixXd(Eigen::Map<const Eigen::VectorXd>(lumped.data(), normal.rows()).asDiagonal()) - normal;
      const auto least = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(rest, Eigen::EigenvaluesOnly).eigenvalues()[0];
      EXPECT_GE(least, -1e-12 * normal.cwiseAbs().maxCoeff());
    }
  }
}

TEST(ThirdDerivatives, have_the_energies_of_polynomials) {
  // On [0, 1] x [0, 1/2]: p = x³ has 36 · area, x² y: 3 · 4 · area, x y²: 3 · 4 · area, y³: 36 · area; and
  // p = x² y²: p_xxy = 4 y, p_xyy = 4 x, so 3 · 16 (∫∫ x² + ∫∫ y²) = 48 (1/6 + 1/24).
  const Rectangle half{Interval(0, 1, 12), Interval(0, 0.5, 7)};
  const std::vector<std::pair<std::array<int, 2>, double>> cases = {
      {{3, 0}, 18}, {{2, 1}, 6}, {{1, 2}, 6}, {{0, 3}, 18}, {{2, 2}, 10}, {{2, 0}, 0}, {{1, 1}, 0}};
  for (const int degree : {3, 4, 5}) {
    const Hierarchy h(Energy::third_derivatives(), half, degree);
    const auto& space = h.finest().space;
    for (const auto& [powers, expected] : cases) {
      // coefficients of x^a y^b: products of blossoms, the mean of products of a different knots
      const auto blossom = [](const SplineBasis& basis, int power) {
        std::vector<double> result;
        const int d = basis.degree(), n = basis.interval().cells();
        const double cell = basis.interval().finest_cell_length();
        for (int i = 0; i < basis.size(); ++i) {
          std::vector<double> symmetric = {1, 0, 0, 0};  // elementary symmetric polynomials of the knots
          for (int k = 1; k <= d; ++k)
            for (std::size_t m = 3; m > 0; --m) symmetric[m] += cell * std::clamp(i + k - d, 0, n) * symmetric[m - 1];
          double choose = 1;
          for (int k = 0; k < power; ++k) choose = choose * (d - k) / (k + 1);
          result.push_back(symmetric[static_cast<std::size_t>(power)] / choose);
        }
        return result;
      };
      std::vector<double> c, image(space.size());
      for (const double y : blossom(space.y, powers[1]))
        for (const double x : blossom(space.x, powers[0])) c.push_back(x * y);
      EXPECT_NEAR(evaluate_energy(h.energy(), space, c), expected, 1e-9);
      for (int j = 0; j < h.finest().energy.rows(); ++j)
        h.finest().energy.precise_row(j, c, image.data() + static_cast<std::size_t>(j * space.x.size()));
      EXPECT_NEAR(test::dot(c, image), expected, 1e-9);
      h.finest().energy.apply(c, image);
      EXPECT_NEAR(test::dot(c, image), expected, 1e-7);
    }
  }
}

TEST(ThirdDerivatives, are_symmetric_and_galerkin_on_every_level) {
  for (const int degree : {3, 4, 5}) {
    const Hierarchy h(Energy::third_derivatives(), {Interval(0, 1, 37), Interval(0, 1, 32)}, degree);
    for (int k = 0; k < h.size(); ++k) {
      test::expect_symmetric(h[k].energy);
      if (k + 1 < h.size()) test::expect_galerkin(h[k], h[k + 1]);
    }
  }
}

TEST(ThirdDerivatives, by_differences_are_the_rows_of_the_operator) {
  using enum EndCondition;
  const std::vector<SpaceEnds> ends = {{},
                                       {{Zero, Clamped}, {Flat, Free}},
                                       {{Flat, Flat}, {Clamped, Flat}},
                                       {{Periodic, Periodic}, {Zero, Flat}},
                                       {{Free, Flat}, {Periodic, Periodic}},
                                       {{Periodic, Periodic}, {Periodic, Periodic}}};
  for (const SpaceEnds& e : ends)
    for (const int degree : {3, 4, 5})
      for (const auto& [nx, ny] : {std::pair{12, 11}, {12, 40}, {601, 24}}) {
        const SplineSpace space = finest_space({Interval(0, 1, nx), Interval(0, 1, ny)}, degree, {}, e);
        const Operator energy(Energy::third_derivatives(), space);
        auto c = test::random_vector(space.size(), 3);
        const int columns = space.x.size();
        for (int i = 0; i < static_cast<int>(c.size()); ++i)
          if (space.is_removed(i % columns, i / columns)) c[static_cast<std::size_t>(i)] = 0;
        fill_images(space, c);
        std::vector<double> expected(static_cast<std::size_t>(columns)), found(expected.size());
        double largest = 0, error = 0;
        for (int j = 0; j < space.y.size(); ++j) {
          energy.row(j, c, expected.data());
          energy.precise_row(j, c, found.data());
          for (std::size_t i = 0; i < found.size(); ++i) {
            largest = std::max(largest, std::abs(expected[i]));
            error = std::max(error, std::abs(found[i] - expected[i]));
          }
        }
        EXPECT_LE(error, 1e-13 * largest) << nx << " x " << ny << ", degree " << degree;
      }
}

TEST(Multigrid, of_slopes_needs_as_many_iterations_on_every_grid) {
  // Gradients of sin(2 x + y) with noise, thin plate and third derivatives; λ at which data and energy both matter.
  test::Random random(5);
  FitData d;
  for (int i = 0; i < 1000; ++i) {
    const double x = random(), y = random();
    for (const bool second : {false, true}) {
      d.x.push_back(x);
      d.y.push_back(y);
      d.value.push_back((second ? 1 : 2) * std::cos(2 * x + y) + 0.1 * random.normal());
      d.weight.push_back(1. / 2000);
      d.kind.push_back(second ? Measured::SlopeY : Measured::SlopeX);
    }
  }
  for (const auto& energy : {Energy::thin_plate(), Energy::third_derivatives()})
    for (const int cells : {64, 128, 256}) {
      FitOptions options;
      options.energy = energy;
      FitProblem problem(d, test::unit_square(cells, cells), options);
      const double lambda = energy.order() == 3 ? 1e-6 : 1e-3;
      problem.system().set(lambda, problem.weight());
      const auto b = problem.right_side(problem.weight(), problem.value());
      std::vector<double> c(b.size()), image(b.size());
      const auto result = solve(problem.system(), b, c, {.accuracy = 1e-10, .most_iterations = 100});
      EXPECT_LE(result.iterations, 17) << "order " << energy.order() << ", " << cells << " cells";
      EXPECT_LE(result.accuracy, 1e-9);
    }
}

}  // namespace
}  // namespace batten
