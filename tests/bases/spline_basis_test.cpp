// SPDX-License-Identifier: MIT
#include <batten/bases/spline_basis.h>
#include <batten/bases/spline_pieces.h>
#include <batten/domains/errors.h>

#include "../support/laws.h"
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

using test::dense;

SplineBasis basis(int cells, int degree) { return {Interval(0, 1, cells), degree}; }

void expect_row(const BandedRows& m, int i, int first, const std::vector<double>& expected) {
  for (int j = 0; j < m.columns; ++j) {
    const int k = j - first;
    const double e = k < 0 || k >= static_cast<int>(expected.size()) ? 0. : expected[static_cast<std::size_t>(k)];
    EXPECT_NEAR(m(i, j), e, 1e-15 * 16) << "row " << i << " column " << j;
  }
}

std::vector<double> over(std::vector<double> numerators, double denominator) {
  for (double& n : numerators) n /= denominator;
  return numerators;
}

TEST(SplineBasis, inner_products_of_cubics_have_the_printed_interior_rows) {
  const auto b = basis(20, 3);
  expect_row(b.inner_products(0), 10, 7, over({1, 120, 1191, 2416, 1191, 120, 1}, 5040));
  expect_row(b.inner_products(1), 10, 7, over({-1, -24, -15, 80, -15, -24, -1}, 120));
  expect_row(b.inner_products(2), 10, 7, over({1, 0, -9, 16, -9, 0, 1}, 6));
}

TEST(SplineBasis, inner_products_of_quadratics_have_the_known_interior_rows) {
  const auto b = basis(20, 2);
  expect_row(b.inner_products(0), 10, 8, over({1, 26, 66, 26, 1}, 120));
  expect_row(b.inner_products(1), 10, 8, over({-1, -2, 6, -2, -1}, 6));
  expect_row(b.inner_products(2), 10, 8, {1, -4, 6, -4, 1});
}

TEST(SplineBasis, inner_products_of_the_finest_level_are_integers_over_one_denominator) {
  for (int degree : {2, 3})
    for (int r : {0, 1, 2}) {
      const auto m = basis(50, degree).inner_products(r);
      for (double w : m.weights) EXPECT_EQ(w, std::round(w));
    }
}

TEST(SplineBasis, derivative_products_vanish_exactly_on_constants_and_second_ones_on_linear_functions) {
  for (int degree : {2, 3}) {
    const auto b = basis(40, degree);
    const auto m1 = b.inner_products(1), m2 = b.inner_products(2);
    // Coefficients of t: Greville abscissae, times the degree to stay integers.
    const auto greville = [&](int j) {
      double sum = 0;
      for (int k = 1; k <= degree; ++k) sum += std::clamp(j + k - degree, 0, 40);
      return sum;
    };
    for (int i = 0; i < b.size(); ++i) {
      double constant1 = 0, constant2 = 0, linear = 0;
      for (int k = 0; k < m1.width; ++k) constant1 += m1.row(i)[static_cast<std::size_t>(k)];
      for (int k = 0; k < m2.width; ++k) {
        constant2 += m2.row(i)[static_cast<std::size_t>(k)];
        linear += m2.row(i)[static_cast<std::size_t>(k)] * greville(m2.first[static_cast<std::size_t>(i)] + k);
      }
      EXPECT_EQ(constant1, 0);
      EXPECT_EQ(constant2, 0);
      EXPECT_EQ(linear, 0);
    }
  }
}

TEST(SplineBasis, inner_products_equal_differences_of_lower_mass_matrices) {
  for (int degree : {2, 3, 4})
    for (int cells : {1, 2, 3, 5, 9, 40})
      for (int r = 1; r <= 2; ++r) {
        const auto b = basis(cells, degree);
        Eigen::MatrixXd D = dense(b.differences());
        if (r == 2) D = dense(basis(cells, degree - 1).differences()) * D;
        const Eigen::MatrixXd M = dense(basis(cells, degree - r).inner_products(0));
        EXPECT_LT((D.transpose() * M * D - dense(b.inner_products(r))).cwiseAbs().maxCoeff(), 1e-13 * 100)
            << degree << " " << cells << " " << r;
      }
}

TEST(SplineBasis, refinement_represents_the_coarse_functions_down_to_the_coarsest_level) {
  for (int degree : {1, 2, 3, 4})
    for (int cells : {2, 3, 5, 8, 13, 64, 101}) {
      SCOPED_TRACE(testing::Message() << "degree " << degree << ", " << cells << " cells");
      for (auto fine = basis(cells, degree); fine.interval().can_coarsen(); fine = fine.coarser())
        test::expect_refinement_represents(fine.coarser(), fine);
    }
}

TEST(SplineBasis, coarse_inner_products_are_galerkin) {
  for (int degree : {2, 3})
    for (int cells : {2, 7, 64, 101, 127})
      for (int r : {0, 1, 2}) {
        auto fine = basis(cells, degree);
        while (fine.interval().can_coarsen()) {
          const auto coarse = fine.coarser();
          const auto R = dense(coarse.refinement(fine));
          const Eigen::MatrixXd exact = dense(coarse.inner_products(r));
          const Eigen::MatrixXd galerkin = R.transpose() * dense(fine.inner_products(r)) * R;
          EXPECT_LT((exact - galerkin).cwiseAbs().maxCoeff(), 1e-13 * exact.cwiseAbs().maxCoeff())
              << degree << " " << cells << " r = " << r;
          fine = coarse;
        }
      }
}

TEST(SplineBasis, refinement_has_the_subdivision_rules_inside) {
  const auto R = basis(20, 3).refinement(basis(40, 3));
  expect_row(R, 20, 10, over({1, 1}, 2));
  expect_row(R, 21, 10, over({1, 6, 1}, 8));
}

TEST(SplineBasis, functions_sum_to_one_and_derivatives_to_zero) {
  for (int degree : {1, 2, 3, 5})
    for (int cells : {1, 2, 4, 50})
      for (auto b = basis(cells, degree);; b = b.coarser()) {
        SCOPED_TRACE(testing::Message() << "degree " << degree << ", " << cells << " cells");
        test::expect_partition_of_unity(b);
        if (!b.interval().can_coarsen()) break;
      }
}

TEST(SplineBasis, derivative_is_the_finite_difference) {
  const auto b = basis(30, 3).coarser();
  const double h = 1e-5;
  for (int s = 1; s < 60; ++s) {
    const double t = 0.5 * s + 0.1234 * (s % 2);
    if (t + h >= 30) continue;
    const auto lower = b.at(t - h), upper = b.at(t + h), slope = b.at(t, 1);
    if (lower.first != upper.first) continue;
    for (std::size_t a = 0; a < 4; ++a)
      EXPECT_NEAR((upper.values[a] - lower.values[a]) / (2 * h), slope.values[a], 1e-9);
  }
}

TEST(SplineBasis, samples_are_the_values_at_the_breakpoints) {
  for (int degree : {2, 3})
    for (int cells : {1, 2, 3, 31})
      for (int r : {0, 1}) {
        const auto b = basis(cells, degree);
        const auto S = dense(b.samples(r));
        for (int i = 0; i <= cells; ++i) {
          const auto local = b.at(i, r);
          Eigen::VectorXd row = Eigen::VectorXd::Zero(b.size());
          for (int a = 0; a <= degree; ++a) row[local.first + a] = local.values[static_cast<std::size_t>(a)];
          EXPECT_LT((S.row(i).transpose() - row).cwiseAbs().maxCoeff(), 1e-14 * 10)
              << degree << " " << cells << " " << i;
        }
      }
}

TEST(SplineBasis, samples_of_the_highest_derivative_are_the_mean_of_its_limits) {
  for (int degree : {1, 2, 3, 5})
    for (int cells : {1, 2, 3, 31}) {
      const auto b = basis(cells, degree);
      const auto S = dense(b.samples(degree));
      for (int i = 0; i <= cells; ++i) {
        Eigen::VectorXd row = Eigen::VectorXd::Zero(b.size());
        const bool is_end = i == 0 || i == cells;
        for (const double t : {i - 0.5, i + 0.5}) {  // it is constant in a cell
          if (t < 0 || t > cells) continue;
          const auto local = b.at(t, degree);
          for (int a = 0; a <= degree; ++a)
            row[local.first + a] += (is_end ? 1 : 0.5) * local.values[static_cast<std::size_t>(a)];
        }
        EXPECT_LT((S.row(i).transpose() - row).cwiseAbs().maxCoeff(), 1e-11) << degree << ' ' << cells << ' ' << i;
      }
      EXPECT_EQ(dense(b.samples(degree + 1)).cwiseAbs().maxCoeff(), 0);
    }
}

TEST(SplineBasis, repeating_rows_repeat) {
  for (const auto& m : {basis(64, 3).inner_products(2), basis(64, 3).refinement(basis(129, 3)),
                        transposed(basis(64, 2).refinement(basis(128, 2)))}) {
    EXPECT_GT(m.end - m.begin, m.rows / 2);
    for (int i = m.begin; i + m.period < m.end; ++i) {
      const auto next = static_cast<std::size_t>(i + m.period);
      EXPECT_EQ(m.first[next], m.first[static_cast<std::size_t>(i)] + m.shift);
      for (std::size_t k = 0; k < static_cast<std::size_t>(m.width); ++k)
        EXPECT_EQ(m.row(i)[k], m.row(i + m.period)[k]);
    }
  }
}

TEST(SplineBasis, refuses_degrees_that_it_does_not_have) {
  EXPECT_THROW(basis(4, -1), InvalidInput);
  EXPECT_THROW(basis(4, 6), InvalidInput);
}

TEST(SplinePieces, are_exact) {
  const std::vector<int> breakpoints = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  const auto pieces = spline_pieces(breakpoints, 3);
  EXPECT_EQ(pieces[4].coefficients[0][0], Rational(1, 6));
  EXPECT_EQ(pieces[4].coefficients[1][0], Rational(2, 3));
  EXPECT_EQ(pieces[4].coefficients[3][3], Rational(1, 6));
  const auto mass = exact_inner_products(breakpoints, 3, 0, 0);
  EXPECT_EQ(mass[5][3], Rational(2416, 5040));
  EXPECT_EQ(mass[0][3], Rational(1, 7));  // ∫ (1-t)^6
}

TEST(SplinePieces, repeat_where_the_knots_around_a_cell_do) {
  // Knots 0 0 0 1 2 3 4 5 6 8 8 8; the quadratic pieces of cell c depend on four of them, from the second that c
  // counts.
  const auto pieces = spline_pieces(std::vector{0, 1, 2, 3, 4, 5, 6, 8}, 2);
  std::vector<bool> repeats;
  for (const auto& piece : pieces) repeats.push_back(piece.repeats);
  EXPECT_EQ(repeats, (std::vector{false, false, true, true, true, false, false}));
  const Rational half(1, 2);
  const std::vector<std::vector<Rational>> uniform = {{half, -1, half}, {half, 1, -1}, {0, 0, half}};
  for (const std::size_t cell : {1u, 2u, 3u, 4u}) EXPECT_EQ(pieces[cell].coefficients, uniform) << cell;
  // On [5, 6], knots 4 5 6 8: the first (1 - u)²/2, the last u²/3.
  EXPECT_EQ(pieces[5].coefficients[0], uniform[0]);
  EXPECT_EQ(pieces[5].coefficients[2], (std::vector<Rational>{0, 0, Rational(1, 3)}));
}

}  // namespace
}  // namespace batten
