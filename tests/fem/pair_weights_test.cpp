// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/block_vectors.h>
#include <batten/fem/fit_problem.h>

#include "../support/laws.h"
#include "../support/message_of.h"
#include "../support/observations.h"
#include "../support/pairs.h"
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace batten {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST(PairWeights, have_an_inverse_and_a_diagonal_above_them) {
  const PairWeights w = test::random_pairs(200, 1, 2, 1);  // condition numbers up to 1e4
  const Eigen::MatrixXd inverse = test::dense(w.inverse()), rest = -test::dense(w);
  EXPECT_LT((inverse * test::dense(w) - Eigen::MatrixXd::Identity(400, 400)).cwiseAbs().maxCoeff(), 1e4 * 8 * epsilon);
  const auto lumped = w.lumped();
  for (std::size_t k = 0; k < 400; k += 2) {
    const auto i = static_cast<Eigen::Index>(k);
    Eigen::Matrix2d block = rest.block<2, 2>(i, i);
    block.diagonal() += Eigen::Map<const Eigen::VectorXd>(lumped.data() + i, 2);
    EXPECT_GE(test::least_eigenvalue(block), -4 * epsilon * std::max(lumped[k], lumped[k + 1]));
    EXPECT_LE(lumped[k], 2 * w.diagonal[k]);
  }
}

TEST(PairWeights, soften_as_springs_in_series) {
  PairWeights w = test::random_pairs(200, 1, 2, 2);
  const Eigen::MatrixXd before = test::dense(w.inverse());
  std::vector<double> give = test::random_vector(400, 3);
  for (double& g : give) g = 1.5 + g;
  w.soften(give);
  const Eigen::MatrixXd expected = before + Eigen::MatrixXd(Eigen::Map<Eigen::VectorXd>(give.data(), 400).asDiagonal());
  // compliances up to 100 and softened weights below 2
  EXPECT_LT((expected * test::dense(w) - Eigen::MatrixXd::Identity(400, 400)).cwiseAbs().maxCoeff(), 1e4 * 8 * epsilon);
}

TEST(PairWeights, stay_definite_where_rounding_leaves_one_direction) {
  PairWeights w(std::array{1e9, 1e-3}, std::array{-1e3});
  EXPECT_GT(test::dense(w).determinant(), 0);
  EXPECT_GT(w.inverse().diagonal[0], 0);
  w.soften(std::array{1e-9, 1e3});
  // W = n n^T with n = (1e4.5, -1e-1.5), so that softened W is n n^T / (1 + 1e-9 · 1e9 + 1e3 · 1e-3)
  EXPECT_NEAR(w.diagonal[0], 1e9 / 3, 1e9 * 1e-12);
  EXPECT_NEAR(w.diagonal[1], 1e-3 / 3, 1e-3 * 1e-12);
  EXPECT_NEAR(w.beside[0], -1e3 / 3, 1e3 * 1e-12);
}

TEST(PairWeights, refuse_blocks_that_are_none_or_indefinite) {
  const std::vector<double> three{1, 2, 3}, four{1, 4, 9, 1};
  EXPECT_EQ(message_of<InvalidInput>([&] { PairWeights(three, std::array{0.}); }),
            "PairWeights: expected a number beside each pair of 3 rows, found 1");
  EXPECT_EQ(message_of<InvalidInput>([&] {
              PairWeights(four, std::array{1.9, -3.1});
            }),
            "PairWeights: expected positive definite blocks, found 9 and 1 with -3.1 beside them in block 2");
  EXPECT_THROW(PairWeights(four, std::array{std::nan(""), 0.}), InvalidInput);
}

/// Slopes in x and y at random places of the unit square, as those of vectors are.
FitData slopes(std::size_t vectors) {
  test::Random random(5);
  FitData d;
  for (std::size_t i = 0; i < vectors; ++i) {
    const double x = random(), y = random();
    for (const Measured kind : {Measured::SlopeY, Measured::SlopeX}) {
      d.x.push_back(x);
      d.y.push_back(y);
      d.value.push_back(random() - 0.5);
      d.weight.push_back(0.5 / static_cast<double>(vectors));
      d.kind.push_back(kind);
      d.source.push_back(i);
    }
  }
  return d;
}

FitOptions third_derivatives() {
  FitOptions options;
  options.energy = Energy::third_derivatives();
  options.degree = 3;
  return options;
}

Eigen::Map<const Eigen::VectorXd> view(const std::vector<double>& v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

TEST(DataTerm, of_pairs_equals_its_matrix_in_both_forms_and_is_below_its_lumped_one) {
  const FitData data = slopes(70);
  const FitProblem problem(data, test::unit_square(14, 11), third_derivatives());
  const PairWeights weights = test::random_pairs(70, 1, 6, 4);
  for (int level = 0; level < problem.hierarchy().size(); ++level) {
    const auto& space = problem.hierarchy()[level].space;
    const Eigen::MatrixXd b = DataTerm(space, problem.points()).columns();
    const Eigen::MatrixXd normal = b * test::dense(weights) * b.transpose();
    const double largest = normal.cwiseAbs().maxCoeff();
    const auto c = test::random_vector(space.size(), 7);
    for (const bool stored : {false, true}) {
      DataTerm term(space, problem.points(), stored);
      term.set_weights(weights);
      std::vector<double> found(space.size());
      term.add_normal(3, c, found);
      EXPECT_LT((view(found) - 3 * normal * view(c)).cwiseAbs().maxCoeff(), 1e-13 * largest);
      Eigen::MatrixXd rest = -normal;
      const auto lumped = term.lumped();
      rest.diagonal() += view(lumped);
      EXPECT_GE(test::least_eigenvalue(rest), -1e-12 * largest) << "level " << level << " stored " << stored;
    }
  }
}

TEST(DataTerm, of_pairs_gives_the_same_bits_for_every_number_of_threads) {
  const FitData data = slopes(8000);
  const FitProblem problem(data, test::unit_square(150, 150), third_derivatives());
  const auto& space = problem.hierarchy().finest().space;
  const auto c = test::random_vector(space.size(), 7);
  const int before = omp_get_max_threads();
  for (const bool stored : {false, true}) {
    std::vector<std::vector<double>> results;
    for (const int threads : {1, 2, 3}) {
      omp_set_num_threads(threads);
      DataTerm term(space, problem.points(), stored);
      term.set_weights(test::random_pairs(8000, 1, 6, 4));
      results.emplace_back(space.size());
      term.add_normal(1, c, results.back());
    }
    EXPECT_EQ(results[0], results[1]);
    EXPECT_EQ(results[0], results[2]);
  }
  omp_set_num_threads(before);
}

TEST(DataTerm, refuses_pairs_at_different_points) {
  FitData data = slopes(4);
  data.x[3] += 0.01;
  const FitProblem problem(data, test::unit_square(4, 4), third_derivatives());
  DataTerm term(problem.hierarchy().finest().space, problem.points());
  EXPECT_THROW(term.set_weights(test::random_pairs(4, 1, 1, 1)), InvalidInput);
}

/// The system of weights of pairs against λ E + B^T W B as a dense matrix, E by its own application.
void expect_dense_system(const PairWeights& weights, std::size_t vectors, double lambda) {
  const FitData data = slopes(vectors);
  FitProblem problem(data, test::unit_square(12, 12), third_derivatives());
  problem.set(lambda, weights.diagonal, weights.beside);
  const Eigen::MatrixXd b = problem.system().data().columns();
  Eigen::MatrixXd a = b * test::dense(weights) * b.transpose();
  std::vector<double> unit(problem.unknowns()), column(problem.unknowns());
  for (std::size_t i = 0; i < unit.size(); ++i) {
    unit[i] = 1;
    problem.apply_energy(unit, column);
    a.col(static_cast<Eigen::Index>(i)) += lambda * view(column);
    unit[i] = 0;
  }
  const auto c = test::random_vector(problem.unknowns(), 8);
  const Eigen::VectorXd right = a * view(c);
  std::vector<double> image(c.size()), found(c.size());
  problem.apply(c, image);
  EXPECT_LT((view(image) - right).cwiseAbs().maxCoeff(), 1e-13 * a.cwiseAbs().rowwise().sum().maxCoeff());

  const auto result = problem.solve({right.data(), c.size()}, found, {.accuracy = 1e-9}, 0);
  const Eigen::VectorXd error = view(found) - view(c);
  EXPECT_LT(std::sqrt(std::abs(error.dot(a * error)) / view(c).dot(right)), 1e-7)
      << vectors << " vectors, lambda " << lambda;
  EXPECT_LE(result.iterations, 40) << vectors << " vectors, lambda " << lambda;
}

// Two-level hierarchies and more: few vectors one by one, many as stencils; plain and data-aware.
TEST(Multigrid, solves_with_weights_of_pairs) {
  for (const std::size_t vectors : {40, 400})
    for (const double lambda : {1., 1e-5, 1e-10})
      for (const double decades : {1., 6.})
        expect_dense_system(test::random_pairs(vectors, 0.5 / static_cast<double>(vectors), decades, 11), vectors,
                            lambda);
}

}  // namespace
}  // namespace batten
