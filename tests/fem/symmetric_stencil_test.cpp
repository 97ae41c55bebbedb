// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/fit_problem.h>
#include <batten/fem/symmetric_stencil.h>
#include <batten/fem/varying_energy.h>

#include "../support/laws.h"
#include "../support/observations.h"
#include <gtest/gtest.h>

#include <numeric>

namespace batten {
namespace {

/// Random entries wherever both coefficients are on the grid.
SymmetricStencil random_stencil(int rows, int columns, int degree) {
  SymmetricStencil s(rows, columns, degree);
  const auto values = test::random_vector(static_cast<std::size_t>(rows * columns * 64), 5);
  std::size_t next = 0;
  for (int j = 0; j < rows; ++j)
    for (int dy = 0; dy <= std::min(degree, rows - 1 - j); ++dy)
      for (int dx = dy == 0 ? 0 : -degree; dx <= degree; ++dx)
        for (int i = std::max(0, -dx); i < columns - std::max(0, dx); ++i)
          s.entries(j, dx, dy)[static_cast<std::size_t>(i)] = values[next++];
  return s;
}

Eigen::MatrixXd dense(const SymmetricStencil& s) {
  const int d = s.degree(), n = s.columns();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(s.rows() * n, s.rows() * n);
  for (int j = 0; j < s.rows(); ++j)
    for (int i = 0; i < n; ++i)
      for (int dy = 0; dy <= std::min(d, s.rows() - 1 - j); ++dy)
        for (int dx = std::max(-d, -i); dx <= std::min(d, n - 1 - i); ++dx) {
          A(j * n + i, (j + dy) * n + i + dx) = s.entry(i, j, dx, dy);
          A((j + dy) * n + i + dx, j * n + i) = s.entry(i, j, dx, dy);
        }
  return A;
}

TEST(SymmetricStencil, multiplies_like_its_dense_matrix) {
  for (int degree : {2, 3})
    for (const auto& [rows, columns] : {std::pair{1, 1}, {2, 5}, {9, 4}, {12, 31}}) {
      const auto s = random_stencil(rows, columns, degree);
      const auto c = test::random_vector(static_cast<std::size_t>(rows * columns), 3);
      std::vector<double> found(c.size(), 1.);
      s.add_product(-2, c, found);
      const Eigen::VectorXd expected = Eigen::VectorXd::Ones(rows * columns) -
                                       2 * dense(s) * Eigen::Map<const Eigen::VectorXd>(c.data(), rows * columns);
      for (std::size_t i = 0; i < c.size(); ++i) ASSERT_NEAR(found[i], expected[static_cast<Eigen::Index>(i)], 1e-13);
    }
}

std::vector<double> row_sums(const SymmetricStencil& s) {
  const Eigen::VectorXd sums = dense(s).rowwise().sum();
  return {sums.begin(), sums.end()};
}

TEST(SymmetricStencil, multiplies_by_differences_like_its_dense_matrix) {
  for (int degree : {1, 3, 5})
    for (const auto& [rows, columns] : {std::pair{1, 1}, {2, 5}, {12, 31}}) {
      auto s = random_stencil(rows, columns, degree);
      s.set_row_sums(row_sums(s));
      const auto c = test::random_vector(static_cast<std::size_t>(rows * columns), 3);
      std::vector<double> found(c.size(), 1.);
      for (int j = 0; j < rows; ++j)
        s.add_precise_row(j, -2, c, found.data() + static_cast<std::ptrdiff_t>(j) * columns);
      const Eigen::VectorXd expected = Eigen::VectorXd::Ones(rows * columns) -
                                       2 * dense(s) * Eigen::Map<const Eigen::VectorXd>(c.data(), rows * columns);
      for (std::size_t i = 0; i < c.size(); ++i) ASSERT_NEAR(found[i], expected[static_cast<Eigen::Index>(i)], 1e-12);
    }
}

TEST(SymmetricStencil, keeps_row_sums_on_coarser_levels_and_under_conditions_of_the_sides) {
  using enum EndCondition;
  const SpaceEnds conditions[] = {{{Free, Free}, {Free, Free}},
                                  {{Zero, Clamped}, {Flat, Free}},
                                  {{Clamped, Clamped}, {Clamped, Clamped}},
                                  {{Periodic, Periodic}, {Flat, Zero}}};
  for (const auto& ends : conditions) {
    const auto region = test::unit_square(16, 19);
    const auto whole = finest_space(region, 3);
    auto s = random_stencil(whole.y.size(), whole.x.size(), 3);
    s.set_row_sums(row_sums(s));
    const auto kept = s.galerkin(subspace_restriction(finest_space(region, 3, {}, ends)));
    const Hierarchy h(kept, region, 3, {}, ends);
    for (int k = 0; k < h.size(); ++k) {
      const auto& level = *h[k].energy.stencil();
      const auto expected = row_sums(level);
      ASSERT_EQ(level.row_sums().size(), expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(level.row_sums()[i], expected[i], 1e-11);
    }
  }
}

/// A c by differences.
std::vector<double> precise_product(const SymmetricStencil& s, const std::vector<double>& c) {
  std::vector<double> result(c.size());
  for (int j = 0; j < s.rows(); ++j)
    s.add_precise_row(j, 1, c, result.data() + static_cast<std::ptrdiff_t>(j) * s.columns());
  return result;
}

TEST(VaryingStencil, gives_constants_no_energy_but_that_of_the_foundation) {
  BoundaryProblem problem{KirchhoffPlate{}, test::unit_square(64, 48), 3, {}, {}, {}};
  auto& plate = std::get<KirchhoffPlate>(problem.material);
  plate.rigidity = Field([](double x, double y) { return x < 0.5 ? 1e3 : 1 + y; });
  plate.tension = Field([](double x, double) { return x; });
  const auto stiff = varying_stencil(energy_terms(problem), problem.region, 3);
  const std::vector<double> ones(static_cast<std::size_t>(stiff.rows() * stiff.columns()), 1.);
  for (const double v : precise_product(stiff, ones)) ASSERT_EQ(v, 0);
  plate.foundation = Field([](double x, double y) { return 1e-3 * x * y; });
  const auto founded = varying_stencil(energy_terms(problem), problem.region, 3);
  const auto forces = precise_product(founded, ones);
  // ∫∫ 1e-3 x y; entries of E are of size 1e3 / h² = 4e6, and a sum of them would be wrong by 1e-10 of that
  EXPECT_NEAR(std::accumulate(forces.begin(), forces.end(), 0.), 2.5e-4, 1e-17);
}

TEST(SymmetricStencil, galerkin_is_restriction_matrix_refinement) {
  for (int degree : {2, 3})
    for (const auto& [nx, ny] : {std::pair{16, 16}, {19, 33}, {8, 64}}) {
      const Hierarchy h(Energy::thin_plate(), test::unit_square(nx, ny), degree, {});
      ASSERT_GT(h.size(), 1);
      const auto s = random_stencil(h[0].space.y.size(), h[0].space.x.size(), degree);
      const auto coarse = s.galerkin(*h[0].restriction);
      const auto c = test::random_vector(h[1].space.size(), 8);
      const auto fine = test::applied(*h[0].refinement, c);
      std::vector<double> product(fine.size()), found(c.size());
      s.add_product(1, fine, product);
      const auto expected = test::applied(*h[0].restriction, product);
      coarse.add_product(1, c, found);
      for (std::size_t i = 0; i < c.size(); ++i) ASSERT_NEAR(found[i], expected[i], 1e-12);
    }
}

TEST(SymmetricStencil, of_data_on_a_coarse_level_is_that_of_the_points_there) {
  const auto o = test::random_observations(5000, 2, test::franke);
  FitOptions options;
  const auto region = test::unit_square(40, 24);
  const auto prepared = prepare(o, region, options.energy, false);
  const FitProblem problem(prepared.data, region, options);
  const auto& h = problem.hierarchy();
  DataTerm fine(h[0].space, problem.points(), true), direct(h[1].space, problem.points(), true), restricted(direct);
  fine.set_weights(problem.weight());
  direct.set_weights(problem.weight());
  restricted.set_from_finer(fine, *h[0].restriction);
  EXPECT_LT((dense(direct.stencil()) - dense(restricted.stencil())).cwiseAbs().maxCoeff(),
            1e-14 * dense(direct.stencil()).cwiseAbs().maxCoeff() * 100);
}

TEST(SymmetricStencil, refuses_a_degree_it_has_no_kernel_for) { EXPECT_THROW(SymmetricStencil(4, 4, 6), InvalidInput); }

}  // namespace
}  // namespace batten
