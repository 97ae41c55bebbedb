// SPDX-License-Identifier: MIT
#include <batten/fem/data_term.h>
#include <batten/fem/fit_problem.h>

#include "../support/laws.h"
#include "../support/observations.h"
#include <gtest/gtest.h>
#include <omp.h>

namespace batten {
namespace {

/// A problem whose points are ordered by cells.
std::unique_ptr<FitProblem> make_problem(std::size_t points, int nx, int ny, int degree) {
  FitOptions options;
  options.degree = degree;
  const auto o = test::random_observations(points, 4, test::franke);
  const auto prepared = prepare(o, test::unit_square(nx, ny), options.energy, false);
  return std::make_unique<FitProblem>(prepared.data, test::unit_square(nx, ny), options);
}

TEST(DataTerm, equals_its_definition_in_both_forms) {
  for (int degree : {2, 3}) {
    const auto problem = make_problem(300, 23, 40, degree);
    for (int level = 0; level < problem->hierarchy().size(); ++level) {
      const auto& space = problem->hierarchy()[level].space;
      const auto c = test::random_vector(space.size(), 7);
      const auto weights = test::random_vector(problem->size(), 9);
      std::vector<double> expected(space.size()), values(problem->size());
      for (std::size_t i = 0; i < problem->size(); ++i) {
        const auto x = space.x.at(problem->points().x[i]), y = space.y.at(problem->points().y[i]);
        const auto index = [&](int a, int b) {
          return static_cast<std::size_t>(y.first + b) * static_cast<std::size_t>(space.x.size()) +
                 static_cast<std::size_t>(x.first + a);
        };
        const auto product = [&](int a, int b) {
          return x.values[static_cast<std::size_t>(a)] * y.values[static_cast<std::size_t>(b)];
        };
        for (int b = 0; b <= degree; ++b)
          for (int a = 0; a <= degree; ++a) values[i] += product(a, b) * c[index(a, b)];
        for (int b = 0; b <= degree; ++b)
          for (int a = 0; a <= degree; ++a) expected[index(a, b)] += 3 * weights[i] * values[i] * product(a, b);
      }
      for (bool stored : {false, true}) {
        DataTerm term(space, problem->points(), stored);
        term.set_weights(weights);
        std::vector<double> found(space.size()), at_points(problem->size()), adjoint(space.size());
        term.add_normal(3, c, found);
        term.values(c, at_points);
        for (std::size_t i = 0; i < problem->size(); ++i) {
          ASSERT_NEAR(at_points[i], values[i], 1e-14 * 10);
          at_points[i] *= 3 * weights[i];
        }
        term.add_adjoint(at_points, adjoint);
        for (std::size_t i = 0; i < found.size(); ++i) {
          ASSERT_NEAR(found[i], expected[i], 1e-13) << "stored " << stored;
          ASSERT_NEAR(adjoint[i], expected[i], 1e-13);
        }
      }
    }
  }
}

TEST(DataTerm, gives_the_same_bits_for_every_number_of_threads) {
  const auto problem = make_problem(20000, 200, 200, 3);
  const auto& space = problem->hierarchy().finest().space;
  const auto c = test::random_vector(space.size(), 7);
  const int before = omp_get_max_threads();
  for (bool stored : {false, true}) {
    std::vector<std::vector<double>> results;
    for (int threads : {1, 2, 3}) {
      omp_set_num_threads(threads);
      DataTerm term(space, problem->points(), stored);
      term.set_weights(problem->weight());
      results.emplace_back(space.size());
      term.add_normal(1, c, results.back());
    }
    EXPECT_EQ(results[0], results[1]);
    EXPECT_EQ(results[0], results[2]);
  }
  omp_set_num_threads(before);
}

}  // namespace
}  // namespace batten
