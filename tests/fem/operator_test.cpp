// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/hierarchy.h>

#include "../support/laws.h"
#include "../support/polynomials.h"
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

const std::vector<Energy> energies = {Energy::thin_plate(), Energy::membrane(), Energy::tension(0.3)};

Rectangle grid(int nx, int ny, double width = 1, double height = 1) {
  return {Interval(0, width, nx), Interval(0, height, ny)};
}

TEST(Operator, is_symmetric_and_galerkin_on_every_level) {
  for (const auto& energy : energies)
    for (int degree : {2, 3})
      for (const auto& [nx, ny] : {std::pair{32, 32}, {61, 40}, {127, 33}, {300, 17}}) {
        SCOPED_TRACE(testing::Message() << nx << " x " << ny << " degree " << degree);
        const Hierarchy h(energy, grid(nx, ny), degree);
        for (int k = 0; k < h.size(); ++k) {
          test::expect_symmetric(h[k].energy);
          if (k + 1 < h.size()) test::expect_galerkin(h[k], h[k + 1]);
        }
      }
}

TEST(Operator, bound_exceeds_the_largest_eigenvalue_of_the_scaled_energy) {
  for (const auto& energy : energies)
    for (int degree : {2, 3}) {
      const Hierarchy h(energy, grid(37, 20), degree);
      for (int k = 0; k < h.size(); ++k) {
        const auto& space = h[k].space;
        const auto n = static_cast<Eigen::Index>(space.size());
        Eigen::MatrixXd scaled(n, n);
        const auto diagonal = h[k].energy.diagonal();
        for (Eigen::Index a = 0; a < n; ++a)
          for (Eigen::Index b = 0; b < n; ++b)
            scaled(a, b) =
                h[k].energy.entry(static_cast<int>(a) % space.x.size(), static_cast<int>(a) / space.x.size(),
                                  static_cast<int>(b) % space.x.size(), static_cast<int>(b) / space.x.size()) /
                std::sqrt(diagonal[static_cast<std::size_t>(a)] * diagonal[static_cast<std::size_t>(b)]);
        const double largest =
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
        EXPECT_LE(largest, h[k].bound);
        EXPECT_GT(largest, 0.85 * h[k].bound);
      }
    }
}

TEST(Operator, null_space_is_exactly_the_stated_polynomials) {
  for (const auto& energy : energies)
    for (int degree : {2, 3}) {
      const Hierarchy h(energy, grid(6, 5), degree);
      const auto& e = h.finest().energy;
      const int nx = h.finest().space.x.size(), n = static_cast<int>(h.finest().space.size());
      Eigen::MatrixXd matrix(n, n);
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b) matrix(a, b) = e.entry(a % nx, a / nx, b % nx, b / nx);
      const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
      const int nullity = energy.null_degree() == 1 ? 3 : 1;
      EXPECT_LT(std::abs(values[nullity - 1]), 1e-12 * values[n - 1]);
      EXPECT_GT(values[nullity], 1e-7 * values[n - 1]);
    }
}

TEST(Operator, of_the_thin_plate_annihilates_linear_functions_to_rounding_at_any_size) {
  const Hierarchy h(Energy::thin_plate(), grid(1024, 64), 3);
  const auto c = test::polynomial_coefficients(h.finest().space, {{3, 2}, {5, 0}});  // 3 + 2 y + 5 x
  const auto e = test::applied(h.finest().energy, c);
  const auto diagonal = h.finest().energy.diagonal();
  for (std::size_t i = 0; i < e.size(); ++i) EXPECT_LT(std::abs(e[i]), 8 * 2.3e-16 * 10 * 8 * diagonal[i]);
}

// Exact: integrals of monomials.
TEST(Energy, of_polynomials_is_right_to_nine_digits_at_1024_with_offsets) {
  for (double offset : {0., 1000.})
    for (const auto& a : std::vector<test::Polynomial>{{{0, 0, 0, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 0}},
                                                       {{1, -2, 0.5, 3}, {0, 1, 2, -1}, {1, 0, -3, 0.25}, {2, 1, 0, 1}},
                                                       {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 1}}}) {
      auto p = a;
      p[0][0] += offset;
      const Hierarchy h(Energy::thin_plate(), grid(1024, 1024), 3);
      const auto c = test::polynomial_coefficients(h.finest().space, p);
      for (const auto& energy : energies) {
        const double exact = test::polynomial_energy(energy, p);
        EXPECT_NEAR(evaluate_energy(energy, h.finest().space, c), exact, 1e-9 * exact) << "offset " << offset;
      }
    }
}

TEST(Energy, is_measured_with_the_longer_side_of_length_one) {
  // p = (x / 4)² + (x / 4) (y / 4) on [0, 4] x [0, 2]: normalised s² + s t on [0, 1] x [0, 1/2].
  const Hierarchy h(Energy::thin_plate(), grid(16, 8, 4, 2), 3);
  const auto c = test::polynomial_coefficients(h.finest().space, {{0, 0}, {0, 1}, {1, 0}});
  EXPECT_NEAR(evaluate_energy(h.energy(), h.finest().space, c), (4 + 2) * 0.5, 1e-11);
}

TEST(Energy, aspect_stretches_y) {
  // [0, 1] x [0, 1] with aspect 2 is [0, 1/2] x [0, 1] in normalised coordinates; p = s² there.
  const Hierarchy h(Energy::thin_plate(), grid(16, 16), 3, {2});
  const auto c = test::polynomial_coefficients(h.finest().space, {{0}, {0}, {1}});
  EXPECT_NEAR(evaluate_energy(h.energy(), h.finest().space, c), 4 * 0.5, 1e-11);
}

TEST(Energy, refuses_tensions_outside_zero_to_one) {
  EXPECT_THROW(Energy::tension(-0.1), InvalidInput);
  EXPECT_THROW(Energy::tension(1.1), InvalidInput);
  EXPECT_THROW(Energy::tension(std::nan("")), InvalidInput);
}

TEST(Hierarchy, refuses_degrees_and_cells_that_it_does_not_have) {
  EXPECT_THROW(Hierarchy(Energy::membrane(), grid(8, 8), 0), InvalidInput);
  EXPECT_THROW(Hierarchy(Energy::membrane(), grid(8, 8), 6), InvalidInput);
  EXPECT_THROW(Hierarchy(Energy::thin_plate(), grid(8, 8), 1), InvalidInput);
  EXPECT_THROW(Hierarchy(Energy::membrane(), grid(1, 8), 3), InvalidInput);
}

TEST(Hierarchy, ends_at_a_level_that_is_cheap_to_factor) {
  for (const auto& [nx, ny] : {std::pair{256, 256}, {2048, 16}, {1000, 700}, {5, 5}, {2, 2}, {1023, 509}}) {
    const Hierarchy h(Energy::thin_plate(), grid(nx, ny, nx, ny), 3);
    EXPECT_LE(h[h.size() - 1].space.size(), 1200u) << nx << " x " << ny;
  }
}

}  // namespace
}  // namespace batten
