// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/fit_problem.h>

#include "../support/laws.h"
#include "../support/observations.h"
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

namespace batten {
namespace {

struct Trial {
  FitOptions options;
  PreparedData prepared;
  FitProblem problem;

  Trial(const Observations& o, const Rectangle& region, const Energy& energy, int degree)
      : options{.energy = energy, .degree = degree, .smoothing = {}, .limits = {}, .progress = {}},
        prepared(prepare(o, region, energy, false)),
        problem(prepared.data, region, options) {}

  IterationResult solve_for(double lambda, std::vector<double>& c, double accuracy = 1e-10) {
    problem.system().set(lambda, problem.weight());
    c.assign(problem.system().size(), 0.);
    return solve(problem.system(), problem.right_side(problem.weight(), problem.value()), c, {accuracy, 500});
  }
};

/// A λ at which data and energy both matter for about 2000 points.
double moderate_lambda(const Energy& energy) { return energy.order() == 2 ? 1e-6 : 1e-2; }

TEST(Multigrid, needs_at_most_12_iterations_for_every_energy_degree_and_size) {
  const auto o = test::random_observations(2000, 1, test::franke);
  for (const auto& energy : {Energy::thin_plate(), Energy::membrane(), Energy::tension(0.5)})
    for (int degree : {2, 3})
      for (const auto& [nx, ny] : {std::pair{64, 64}, {128, 128}, {256, 256}, {512, 512}, {250, 175}, {255, 127}}) {
        const Rectangle square_cells{Interval(0, 1, nx), Interval(0, double(ny) / nx, ny)};
        Trial s(o, square_cells, energy, degree);
        std::vector<double> c;
        const auto result = s.solve_for(moderate_lambda(energy), c);
        EXPECT_LE(result.iterations, 12) << "degree " << degree << ", " << nx << " x " << ny << ", order "
                                         << energy.order();
        EXPECT_LE(result.accuracy, 1e-9);
      }
}

TEST(Multigrid, needs_at_most_20_iterations_for_cells_that_are_not_square) {
  const auto o = test::random_observations(2000, 1, test::franke);
  for (const auto& energy : {Energy::thin_plate(), Energy::membrane()})
    for (const auto& [nx, ny] : {std::pair{250, 175}, {256, 64}, {32, 256}}) {
      Trial s(o, test::unit_square(nx, ny), energy, 3);
      std::vector<double> c;
      EXPECT_LE(s.solve_for(moderate_lambda(energy), c).iterations, 20)
          << nx << " x " << ny << ", order " << energy.order();
    }
}

TEST(Multigrid, needs_at_most_24_iterations_for_every_lambda) {
  const auto o = test::random_observations(2000, 1, test::franke);
  for (const auto& energy : {Energy::thin_plate(), Energy::membrane(), Energy::tension(0.01)})
    for (int degree : {2, 3}) {
      Trial s(o, test::unit_square(128, 128), energy, degree);
      for (double lambda : {1e12, 1e2, 1., 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14}) {
        std::vector<double> c;
        EXPECT_LE(s.solve_for(lambda, c).iterations, 24) << "degree " << degree << ", lambda " << lambda;
      }
    }
}

TEST(Multigrid, starting_from_coarser_levels_saves_a_third_of_the_iterations_for_dense_exact_data) {
  const auto o = test::random_observations(60000, 1, test::franke);
  Trial s(o, test::unit_square(256, 256), Energy::thin_plate(), 3);
  std::vector<double> predicted;
  const auto result = s.solve_for(1e-8, predicted);
  ASSERT_TRUE(s.problem.system().can_predict());
  std::vector<double> c(predicted.size());
  c[0] = 1e-300;  // a start of its own, as good as zero
  const auto from_zero = solve(s.problem.system(), s.problem.right_side(s.problem.weight(), s.problem.value()), c);
  EXPECT_LE(3 * result.iterations, 2 * from_zero.iterations);
  EXPECT_LE(result.accuracy, 1e-9);
  for (std::size_t i = 0; i < c.size(); ++i) ASSERT_NEAR(predicted[i], c[i], 1e-8);
}

TEST(Multigrid, preconditioner_is_symmetric_and_positive) {
  const auto o = test::random_observations(700, 1, test::franke);
  for (double lambda : {1e-2, 1e-7, 1e-14})
    for (int degree : {2, 3}) {
      Trial s(o, test::unit_square(61, 48), Energy::thin_plate(), degree);
      const auto& system = s.problem.system();
      s.problem.system().set(lambda, s.problem.weight());
      const auto x = test::random_vector(system.size(), 1), y = test::random_vector(system.size(), 2);
      std::vector<double> bx(x.size()), by(x.size());
      system.precondition(x, bx);
      system.precondition(y, by);
      const double xx = test::dot(x, bx), yy = test::dot(y, by);
      EXPECT_GT(xx, 0);
      EXPECT_GT(yy, 0);
      EXPECT_NEAR(test::dot(x, by), test::dot(y, bx), 1e-8 * std::sqrt(xx * yy)) << lambda;
    }
}

/// A assembled from its definition and factored by CHOLMOD.
std::vector<double> direct_solution(const FitProblem& problem, double lambda) {
  const auto& level = problem.hierarchy().finest();
  const int nx = level.space.x.size(), ny = level.space.y.size(), d = problem.hierarchy().degree();
  Eigen::SparseMatrix<double> matrix(nx * ny, nx * ny);
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      for (int l = j; l <= std::min(j + d, ny - 1); ++l)
        for (int k = std::max(0, i - d); k <= std::min(i + d, nx - 1); ++k)
          if (l * nx + k >= j * nx + i)
            entries.emplace_back(l * nx + k, j * nx + i, lambda * level.energy.entry(i, j, k, l));
  for (std::size_t p = 0; p < problem.size(); ++p) {
    const auto row = problem.system().data().row(p);
    for (int a = 0; a < (d + 1) * (d + 1); ++a)
      for (int b = 0; b < (d + 1) * (d + 1); ++b) {
        const auto value = [&](int q) {
          return row.x[static_cast<std::size_t>(q % (d + 1))] * row.y[static_cast<std::size_t>(q / (d + 1))];
        };
        const auto index = [&](int q) { return (row.first_y + q / (d + 1)) * nx + row.first_x + q % (d + 1); };
        if (index(a) >= index(b)) entries.emplace_back(index(a), index(b), problem.weight()[p] * value(a) * value(b));
      }
  }
  matrix.setFromTriplets(entries.begin(), entries.end());
  auto c = problem.right_side(problem.weight(), problem.value());
  SparseCholesky(matrix).solve(c);
  return c;
}

TEST(Multigrid, agrees_with_cholmod_on_small_grids) {
  for (const auto& energy : {Energy::thin_plate(), Energy::membrane(), Energy::tension(0.5)})
    for (int degree : {2, 3})
      for (std::size_t points : {300u, 4000u})  // the second has more points than coefficients
        for (double lambda : {1e-3, 1e-6, 1e-8}) {
          Trial s(test::random_observations(points, 2, test::franke), test::unit_square(40, 33), energy, degree);
          std::vector<double> c;
          s.solve_for(lambda, c, 1e-13);
          const auto exact = direct_solution(s.problem, lambda);
          double largest = 0, error = 0;
          for (std::size_t i = 0; i < c.size(); ++i) {
            largest = std::max(largest, std::abs(exact[i]));
            error = std::max(error, std::abs(exact[i] - c[i]));
          }
          EXPECT_LT(error, 1e-8 * largest) << "degree " << degree << ", points " << points << ", lambda " << lambda;
        }
}

TEST(Multigrid, solution_has_the_same_bits_for_every_number_of_threads) {
  const int before = omp_get_max_threads();
  for (std::size_t count : {5000u, 25000u})  // the second has more points than coefficients
    for (double lambda : {1e-6, 1e-13}) {
      const auto o = test::random_observations(count, 3, test::franke);
      std::vector<std::vector<double>> results(3);
      for (int threads : {1, 2, 3}) {
        omp_set_num_threads(threads);
        Trial s(o, test::unit_square(150, 130), Energy::thin_plate(), 3);
        s.solve_for(lambda, results[static_cast<std::size_t>(threads - 1)]);
      }
      EXPECT_EQ(results[0], results[1]);
      EXPECT_EQ(results[0], results[2]);
    }
  omp_set_num_threads(before);
}

TEST(Multigrid, strips_are_solved_like_squares) {
  Observations o = test::random_observations(800, 5, test::franke);
  for (double& x : o.x) x *= 40;
  for (const auto& [nx, ny] : {std::pair{1280, 32}, {1000, 10}, {400, 100}}) {
    Trial s(o, {Interval(0, 40, nx), Interval(0, 1, ny)}, Energy::thin_plate(), 3);
    std::vector<double> c;
    EXPECT_LE(s.solve_for(1e-7, c).iterations, 25) << nx << " x " << ny;
  }
}

TEST(Multigrid, refuses_a_lambda_that_is_not_positive) {
  Trial s(test::random_observations(100, 5, test::franke), test::unit_square(8, 8), Energy::membrane(), 2);
  EXPECT_THROW(s.problem.system().set(0, s.problem.weight()), InvalidInput);
}

TEST(SparseCholesky, refuses_indefinite_matrices) {
  Eigen::SparseMatrix<double> m(2, 2);
  m.insert(0, 0) = 1;
  m.insert(1, 0) = 2;
  m.insert(1, 1) = 1;
  EXPECT_THROW(SparseCholesky{m}, SolverError);
}

}  // namespace
}  // namespace batten
