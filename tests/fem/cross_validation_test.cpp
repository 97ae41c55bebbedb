// SPDX-License-Identifier: MIT
#include <batten/fem/cross_validation.h>
#include <batten/fem/standard_error.h>

#include "../support/observations.h"
#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

using test::franke;
using test::random_observations;
using test::unit_square;

Observations noisy(std::size_t n, unsigned seed, double sigma) {
  test::Random noise(seed + 1000);
  return random_observations(n, seed, [&](double x, double y) { return franke(x, y) + sigma * noise.normal(); });
}

/// Everything about a small problem by dense matrices.
struct Dense {
  Eigen::MatrixXd B, E;
  Eigen::VectorXd w, z;

  explicit Dense(const FitProblem& p) {
    const auto& level = p.hierarchy().finest();
    const int nx = level.space.x.size(), n = static_cast<int>(level.space.size()), d = p.hierarchy().degree();
    B = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(p.size()), n);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const auto row = p.system().data().row(i);
      for (int b = 0; b <= d; ++b)
        for (int a = 0; a <= d; ++a)
          B(static_cast<Eigen::Index>(i), (row.first_y + b) * nx + row.first_x + a) =
              row.x[static_cast<std::size_t>(a)] * row.y[static_cast<std::size_t>(b)];
    }
    E.resize(n, n);
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b) E(a, b) = level.energy.entry(a % nx, a / nx, b % nx, b / nx);
    w = Eigen::Map<const Eigen::VectorXd>(p.weight().data(), static_cast<Eigen::Index>(p.size()));
    z = Eigen::Map<const Eigen::VectorXd>(p.value().data(), static_cast<Eigen::Index>(p.size()));
  }

  /// Coefficients as a function of the data: c = C z.
  Eigen::MatrixXd coefficients(double lambda) const {
    const Eigen::MatrixXd A = lambda * E + B.transpose() * w.asDiagonal() * B;
    return A.ldlt().solve(Eigen::MatrixXd(B.transpose() * w.asDiagonal()));
  }
  double trace(double lambda) const { return (B * coefficients(lambda)).trace(); }
  double score(double lambda) const {
    const Eigen::MatrixXd H = B * coefficients(lambda);
    const Eigen::VectorXd r = z - H * z;
    const double free = 1 - H.trace() / static_cast<double>(z.size());
    return r.dot(w.asDiagonal() * r) / (free * free);
  }
};

TEST(CrossValidation, finds_the_minimum_of_the_exact_score) {
  const auto o = noisy(150, 3, 0.1);
  FitOptions options;
  const auto prepared = prepare(o, unit_square(16, 16), options.energy, false);
  FitProblem problem(prepared.data, unit_square(16, 16), options);
  const auto found = cross_validate(problem, options);
  EXPECT_TRUE(found.interior);
  const Dense dense(problem);
  double least = INFINITY;
  for (double x = -10; x < 0; x += 0.25) least = std::min(least, dense.score(std::pow(10, x)));
  // The probes estimate the trace; the score at the λ found is close to the least one all the same.
  EXPECT_LT(dense.score(found.lambda), 1.05 * least);
}

TEST(EffectiveDegrees, are_the_trace_of_the_influence_matrix) {
  FitOptions options;
  const auto prepared = prepare(noisy(200, 3, 0.1), unit_square(12, 14), options.energy, false);
  FitProblem problem(prepared.data, unit_square(12, 14), options);
  const Dense dense(problem);
  for (double lambda : {1e-8, 1e-5, 1e-2}) {
    problem.system().set(lambda, problem.weight());
    const double exact = dense.trace(lambda);
    const std::vector<double> c(problem.system().size());
    EXPECT_NEAR(uncertainty(problem, c, options).effective_degrees, exact, 1e-3 * exact);
    EXPECT_NEAR(uncertainty(problem, c, options, 0).effective_degrees, exact, 4 * std::sqrt(2 * exact / 64));
  }
}

TEST(CrossValidation, recovers_a_noisy_surface_better_than_ten_times_more_or_less_smoothing) {
  const auto o = noisy(3000, 7, 0.1);
  const auto error = [&](Smoothing s) {
    FitOptions options;
    options.smoothing = s;
    const auto r = fit_surface(o, unit_square(128, 128), options);
    double sum = 0;
    for (int j = 0; j <= 60; ++j)
      for (int i = 0; i <= 60; ++i) sum += std::pow(r.solution.value(i / 60., j / 60.) - franke(i / 60., j / 60.), 2);
    return std::pair(std::sqrt(sum / 3721), r.lambda);
  };
  const auto [best, lambda] = error(Smoothing::automatic());
  EXPECT_LT(best, 0.02);
  EXPECT_LT(best, error(Smoothing::fixed(lambda * 30)).first);
  EXPECT_LT(best, error(Smoothing::fixed(lambda / 30)).first);
}

TEST(CrossValidation, says_when_there_is_no_interior_minimum) {
  FitOptions options;
  const auto p = [](double x, double y) { return x * x + x * y * y; };  // a cubic: exact in the space
  const auto r = fit_surface(random_observations(2500, 2, p), unit_square(32, 32), options);
  EXPECT_TRUE(r.no_interior_minimum);
  EXPECT_EQ(r.lambda, smallest_lambda);
  EXPECT_THAT(r.notes, testing::Contains(testing::HasSubstr("no interior minimum")));
}

TEST(CrossValidation, refinement_on_the_last_grid_costs_about_five_solves) {
  FitOptions options;
  const auto r = fit_surface(noisy(1000, 7, 0.1), unit_square(256, 256), options);
  EXPECT_LT(r.search_iterations, 10 * r.iterations);
  EXPECT_GT(r.refinement_iterations, 0);
  EXPECT_LE(r.refinement_iterations, 5 * r.iterations);  // about five solves at the chosen λ
}

TEST(StandardError, is_that_of_the_dense_formula) {
  FitOptions options;
  options.smoothing = Smoothing::fixed(1e-5);
  options.standard_error = true;
  auto o = noisy(120, 3, 0.1);
  test::Random random(2);
  for (std::size_t i = 0; i < o.size(); ++i) o.weight.push_back(0.5 + random());
  const auto region = unit_square(10, 12);
  const auto r = fit_surface(o, region, options);

  const auto prepared = prepare(o, region, options.energy, false);
  FitProblem problem(prepared.data, region, options);
  const Dense dense(problem);
  const Eigen::MatrixXd C = dense.coefficients(1e-5);
  const Eigen::VectorXd residual = dense.z - dense.B * (C * dense.z);
  const double variance = residual.dot(dense.w.asDiagonal() * residual) / (120 - (dense.B * C).trace());
  const auto& space = problem.hierarchy().finest().space;
  for (const auto& [i, j] : {std::pair{0, 0}, {5, 5}, {10, 12}, {3, 11}}) {
    const auto x = space.x.at(i), y = space.y.at(j);
    Eigen::RowVectorXd b = Eigen::RowVectorXd::Zero(C.rows());
    for (int q = 0; q <= 3; ++q)
      for (int p = 0; p <= 3; ++p)
        b[(y.first + q) * space.x.size() + x.first + p] =
            x.values[static_cast<std::size_t>(p)] * y.values[static_cast<std::size_t>(q)];
    const Eigen::RowVectorXd l = b * C;
    const double expected =
        prepared.data.scale * std::sqrt(variance * (l.array().square() / dense.w.transpose().array()).sum());
    EXPECT_NEAR(r.standard_error[static_cast<std::size_t>(j * 11 + i)], expected, 1e-3 * expected);
  }
  EXPECT_NEAR(r.effective_degrees.value(), (dense.B * C).trace(), 1e-3 * 120);
}

TEST(StandardError, covers_the_true_surface) {
  FitOptions options;
  options.smoothing = Smoothing::automatic();
  options.standard_error = true;
  const auto r = fit_surface(noisy(6000, 5, 0.1), unit_square(40, 40), options);  // by probes
  int covered = 0;
  for (int j = 0; j <= 40; ++j)
    for (int i = 0; i <= 40; ++i) {
      const double error = r.solution.value(i / 40., j / 40.) - franke(i / 40., j / 40.);
      covered += std::abs(error) < 2 * r.standard_error[static_cast<std::size_t>(j * 41 + i)];
    }
  EXPECT_GT(covered, 0.85 * 41 * 41);
}

}  // namespace
}  // namespace batten
