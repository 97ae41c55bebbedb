// SPDX-License-Identifier: MIT
#include <batten/bases/knot_splines.h>
#include <batten/bases/spline_basis.h>
#include <batten/domains/errors.h>

#include "../support/dense.h"
#include "../support/variational_domains.h"
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Ends = KnotSplines::Ends;

MatrixXd products(const KnotSplines& basis, int r) {
  MatrixXd result = MatrixXd::Zero(basis.size(), basis.size());
  for (int c = 0; c < basis.cells(); ++c)
    result.block(c, c, basis.degree() + 1, basis.degree() + 1) += basis.cell_products(c, r);
  return result;
}

double value(const KnotSplines& basis, const VectorXd& c, double t, int order = 0) {
  const int cell = basis.cell_of(t);
  const auto n = basis.at(cell, t - basis.breakpoints().positions()[static_cast<std::size_t>(cell)], order);
  double sum = 0;
  for (int a = 0; a <= basis.degree(); ++a) sum += n[a] * c[cell + a];
  return sum;
}

std::vector<KnotSplines> bases() {
  std::vector<KnotSplines> result;
  for (int degree = 0; degree <= 3; ++degree)
    for (Ends ends : {Ends::Clamped, Ends::Extended})
      for (const auto& cut : {Breakpoints::uniform(0, 3, 10), test::uneven(7, 11, 3)})
        result.emplace_back(cut, degree, ends);
  return result;
}

// The rational derivation of SplineBasis is independent of Gauss's rule and of the recursion here.
TEST(KnotSplines, of_equal_cells_are_those_of_the_exact_basis) {
  for (int degree = 1; degree <= 3; ++degree) {
    const KnotSplines basis(Breakpoints::uniform(0, 9, 9), degree);
    const SplineBasis exact(Interval(0, 9, 9), degree);
    for (int r = 0; r <= degree; ++r)
      EXPECT_LE((products(basis, r) - test::dense(exact.inner_products(r))).cwiseAbs().maxCoeff(), 1e-12);
    const SplineBasis coarse = exact.coarser();
    EXPECT_LE((MatrixXd(basis.coarser().refinement(basis)) - test::dense(coarse.refinement(exact))).norm(), 1e-13);
  }
}

TEST(KnotSplines, reproduce_monomials_and_refine_without_change) {
  for (const auto& fine : bases()) {
    const double length = fine.breakpoints().positions().back();
    const auto coarse = fine.coarser();
    const auto R = coarse.refinement(fine);
    const VectorXd c = test::random_coefficients(coarse.size(), 1), refined = R * c;
    for (int s = 0; s <= 50; ++s) {
      const double t = length * s / 50.001;
      EXPECT_NEAR(value(coarse, c, t), value(fine, refined, t), 1e-13);
      for (int a = 0; a <= fine.degree(); ++a)
        EXPECT_NEAR(value(fine, fine.monomial(a), t), std::pow(2 * t / length - 1, a), 1e-13);
    }
  }
}

TEST(KnotSplines, derivatives_are_limits_of_differences) {
  for (const auto& basis : bases()) {
    const VectorXd c = test::random_coefficients(basis.size(), 2);
    const double h = 1e-5;
    for (int order = 1; order <= basis.degree(); ++order)
      for (int cell = 0; cell < basis.cells(); ++cell) {
        const double u = 0.4 * basis.breakpoints().width(cell);
        const auto above = basis.at(cell, u + h, order - 1), below = basis.at(cell, u - h, order - 1);
        const auto exact = basis.at(cell, u, order);
        for (int a = 0; a <= basis.degree(); ++a)
          EXPECT_NEAR((above[a] - below[a]) / (2 * h), exact[a], 1e-7 * std::pow(10., order));
      }
  }
}

TEST(KnotSplines, moments_integrate_monomials) {
  for (const auto& basis : bases())
    for (int a = 0; a <= std::min(1, basis.degree()); ++a) {
      double integral = 0;
      const VectorXd c = basis.monomial(a);
      for (int cell = 0; cell < basis.cells(); ++cell)
        for (int i = 0; i <= basis.degree(); ++i) integral += basis.cell_moments(cell, a)[i] * c[cell + i];
      const double length = basis.breakpoints().positions().back();
      EXPECT_NEAR(integral, a == 0 ? length : length / 3, 1e-13 * length);  // ∫ s² = length / 3
    }
}

TEST(KnotSplines, cells_of_equal_neighbourhood_have_equal_bits) {
  const KnotSplines basis(Breakpoints::uniform(0.1, 7.3, 40), 3);
  EXPECT_EQ(basis.cell_products(5, 1), basis.cell_products(30, 1));
  EXPECT_THROW(KnotSplines(Breakpoints::uniform(0, 1, 2), 4), InvalidInput);
}

}  // namespace
}  // namespace batten
