// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/operator.h>
#include <batten/fem/variational_scheme.h>

#include "../support/message_of.h"
#include "../support/variational_domains.h"
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::random_coefficients;

double energy(const EnergyLevels::Level& level, const VectorXd& p) { return p.dot(level.E * p); }

/// S_0 .. S_{K-1}.
std::vector<VariationalScheme> schemes(const EnergyLevels& levels, const NullSpaceRule& rule = {}) {
  std::vector<VariationalScheme> result;
  for (int k = 0; k < levels.finest(); ++k) result.emplace_back(levels, k, rule);
  return result;
}

/// Those of natural cubics interpolate at the ends of each level.
std::vector<VariationalScheme> natural_cubic_schemes(const EnergyLevels& levels) {
  std::vector<VariationalScheme> result;
  for (int k = 0; k < levels.finest(); ++k)
    result.emplace_back(levels, k, NullSpaceRule{{0, static_cast<int>(levels.levels[k].E.rows()) - 1}});
  return result;
}

void expect_near(const MatrixXd& found, const MatrixXd& expected, double tolerance) {
  ASSERT_EQ(found.rows(), expected.rows());
  ASSERT_EQ(found.cols(), expected.cols());
  EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), tolerance);
}

// [Warren & Weimer 2001, sec. 6.2.2]: the subdivision matrix of restricted quadratic B-splines and eq. 6.14.
TEST(NaturalCubic, energy_and_refinement_of_restricted_quadratics_are_those_of_the_source) {
  VariationalDomain domain{Breakpoints::uniform(0, 12, 24)};
  domain.energy = Energy::thin_plate();
  domain.degree = 2;
  domain.ends = KnotSplines::Ends::Extended;
  const auto levels = energy_levels(spline_levels(domain, 1));
  MatrixXd E(5, 6), R(5, 3);
  E << 1, -2, 1, 0, 0, 0, -2, 5, -4, 1, 0, 0, 1, -4, 6, -4, 1, 0, 0, 1, -4, 6, -4, 1, 0, 0, 1, -4, 6, -4;
  R << 3, 1, 0, 1, 3, 0, 0, 3, 1, 0, 1, 3, 0, 0, 3;
  expect_near(MatrixXd(levels.levels[0].E).topLeftCorner(5, 6), E, 1e-13);
  expect_near(MatrixXd(levels.levels[1].E).topLeftCorner(5, 6), 8 * E, 1e-12);
  expect_near(MatrixXd(levels.steps[0].R).topLeftCorner(5, 3), R / 4, 1e-15);
  expect_near(MatrixXd(natural_cubic_levels(12, 0).levels[0].E).topLeftCorner(5, 6), E, 0);
}

TEST(NaturalCubic, rules_are_cubic_b_splines_inside_and_interpolate_at_the_ends) {
  const auto levels = natural_cubic_levels(6, 3);
  for (int k = 0; k < 3; ++k) {
    const MatrixXd S = natural_cubic_schemes(levels)[static_cast<std::size_t>(k)].matrix();
    MatrixXd expected = MatrixXd::Zero(S.rows(), S.cols());
    for (Eigen::Index i = 0; i < S.rows(); ++i) {
      const Eigen::Index j = i / 2;
      if (i == 0 || i + 1 == S.rows()) {
        expected(i, j) = 1;
      } else if (i % 2 == 1) {
        expected.row(i).segment(j, 2).setConstant(1. / 2);
      } else {
        expected.row(i).segment(j - 1, 3) << 1. / 8, 3. / 4, 1. / 8;
      }
    }
    expect_near(S, expected, 1e-10);  // the condition of E grows like the fourth power of its size
  }
}

// The operator of the solvers comes from exact rationals and Kronecker products, not from cells and Gauss's rule.
TEST(SplineLevel, energies_are_those_of_the_operator) {
  for (const auto& energy : {Energy::membrane(), Energy::thin_plate(), Energy::tension(0.3)})
    for (int degree : {2, 3}) {
      auto domain = test::variational_domain(energy, degree, 7, 6);
      domain.x = Breakpoints::uniform(1, 3.1, 7);
      domain.y = Breakpoints::uniform(-1, 0.2, 6);
      const MatrixXd E = SplineLevel(domain).energy();
      const SplineBasis x(Interval(1, 3.1, 7), degree), y(Interval(-1, 0.2, 6), degree);
      const Operator expected(energy, {x, y, 0.3, 0.2});
      const int nx = x.size(), n = nx * y.size();
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b)
          ASSERT_NEAR(E(a, b), expected.entry(a % nx, a / nx, b % nx, b / nx), 1e-12 * E.maxCoeff());
    }
}

/// N of [Warren & Weimer 2001, sec. 6.3.1].
MatrixXd natural_cubic_values(Eigen::Index size) {
  MatrixXd N = MatrixXd::Zero(size, size);
  N(0, 0) = N(size - 1, size - 1) = 1;
  for (Eigen::Index i = 1; i + 1 < size; ++i) N.row(i).segment(i - 1, 3) << 1. / 6, 2. / 3, 1. / 6;
  return N;
}

/// Coefficients of a spline with the given energies of p_0 and of the limit.
VectorXd with_energies(const EnergyLevels& levels, double first, double limit) {
  const Eigen::Index n = levels.levels[0].E.rows();
  const MatrixXd N = natural_cubic_values(n);
  const auto mixed = [&](double share) {
    VectorXd p(n);
    for (Eigen::Index i = 0; i < n; ++i)
      p[i] = share * std::cos(M_PI * static_cast<double>(i)) + (1 - share) * std::sin(0.5 * static_cast<double>(i));
    return p;
  };
  double low = 0, high = 1;
  for (int step = 0; step < 100; ++step) {
    const double share = (low + high) / 2;
    const VectorXd p = mixed(share);
    (p.dot(levels.levels[0].E * (N * p)) > limit / first * energy(levels.levels[0], p) ? low : high) = share;
  }
  const VectorXd p = mixed(low);
  return std::sqrt(first / energy(levels.levels[0], p)) * p;
}

// The source prints 71.3139, 42.2004, 34.922, 33.1025, 32.6476, 32.5338 and the limit 32.4959 for a polygon that it
// shows in a figure only. B-spline coefficients are p - h²/6 p'', so the energies tend to the limit exactly like 4^-k:
// every polygon with the first energy and the limit has the others.
TEST(NaturalCubic, energies_of_the_source_fall_fourfold_to_the_exact_limit) {
  const auto levels = natural_cubic_levels(8, 5);
  const double limit = 32.4959;
  const std::vector<double> printed = {71.3139, 42.2004, 34.922, 33.1025, 32.6476, 32.5338};
  const auto p = subdivided(natural_cubic_schemes(levels), with_energies(levels, printed[0], limit));
  const MatrixXd N = natural_cubic_values(p[0].size());
  EXPECT_NEAR(p[0].dot(levels.levels[0].E * (N * p[0])), limit, 1e-10);
  for (std::size_t k = 0; k < printed.size(); ++k) {
    const double found = energy(levels.levels[k], p[k]);
    EXPECT_NEAR(found, printed[k], 1e-4) << "level " << k;
    EXPECT_NEAR(found - limit, std::pow(0.25, k) * (printed[0] - limit), 1e-8) << "level " << k;
    const VectorXd measured = measured_on_coarsest(levels, static_cast<int>(k), p[k]);
    expect_near(measured, N * p[0] + std::pow(0.25, k) * (p[0] - N * p[0]), 1e-7);  // cond E = 5e9
  }
}

/// S_0 of bending on an interval of 20 coarse cells.
VariationalScheme bending_of_line(int degree, const NullSpaceRule& rule = {}) {
  return {energy_levels(spline_levels(test::variational_domain(Energy::thin_plate(), degree, 40, 0), 1)), 0, rule};
}

// With the symbols of E and M, bending gives 8 E(x) S(x) = M(1/x) E(x²):
//   degree 2, M = (1 + x) / 2:           S = (1 + x)^5 / 16, quartic B-splines: the limit keeps averages over cells,
//                                        for the chain M_0 M_1 ... of midpoint values tends to them;
//   degree 3, M = (1/x + 4 + x) / 6 = b: S = (1 + x)^4 / 8 b(x²), natural cubics again, in another basis.
TEST(VariationalScheme, columns_of_bending_are_the_closed_forms_of_its_symbols) {
  // Away from the ends coarse quadratic j lies between fine ones 2 j - 1 and 2 j, coarse cubic j above 2 j - 1.
  VectorXd quartic = VectorXd::Zero(42), cubic = VectorXd::Zero(43);
  quartic.segment(17, 6) << 1, 5, 10, 10, 5, 1;
  cubic.segment(17, 9) << 1, 4, 10, 20, 26, 20, 10, 4, 1;
  expect_near(16 * bending_of_line(2).column(10), quartic, 1e-8);
  expect_near(48 * bending_of_line(3).column(11), cubic, 1e-8);
}

// Integrals tie every row to the columns at the ends, whose local solutions do not keep them; values at the ends do
// not.
TEST(VariationalScheme, rows_of_quadratic_bending_are_local_if_the_ends_are_interpolated) {
  const auto scheme = bending_of_line(2, {{0, 21}});
  VectorXd first = VectorXd::Zero(22), inner = first;
  first.head(3) << 10, 5, 1;
  inner.segment(9, 3) << 1, 10, 5;
  expect_near(16 * scheme.row(1), first, 1e-9);
  expect_near(16 * scheme.row(20), inner, 1e-9);
  EXPECT_GT((16 * bending_of_line(2).row(20) - inner).cwiseAbs().maxCoeff(), 0.01);
}

// In one dimension the flow κ p' is the same in both halves of a coarse cell.
TEST(VariationalScheme, of_a_membrane_in_one_dimension_keeps_the_flow) {
  auto domain = test::variational_domain(Energy::membrane(), 1, 12, 0, false);
  domain.coefficient = test::rough(12, 1000, 3);
  const auto levels = energy_levels(spline_levels(domain, 1));
  const VectorXd p = random_coefficients(7, 1), q = VariationalScheme(levels, 0).apply(p);
  const auto width = [&](int c) { return domain.x.width(c); };
  for (int C = 0; C < 6; ++C) {
    const auto kappa = [&](int c) { return domain.coefficient[static_cast<std::size_t>(c)]; };
    const int c = 2 * C, d = c + 1;
    const double mean = (kappa(c) * width(c) + kappa(d) * width(d)) / (width(c) + width(d));
    const double flow = mean * (p[C + 1] - p[C]) / (width(c) + width(d));
    EXPECT_NEAR((q[d] - q[c]) * kappa(c) / width(c), flow, 1e-9 * std::abs(flow));
    EXPECT_NEAR((q[d + 1] - q[d]) * kappa(d) / width(d), flow, 1e-9 * std::abs(flow));
  }
}

class BellForm : public testing::TestWithParam<test::NamedDomain> {
protected:
  std::vector<SplineLevel> splines = spline_levels(GetParam().domain, 2);
  EnergyLevels levels = energy_levels(splines);
};

TEST_P(BellForm, levels_are_galerkin_with_the_stated_null_space_and_moments) {
  for (int k = 0; k <= levels.finest(); ++k) {
    const auto& level = levels.levels[static_cast<std::size_t>(k)];
    const MatrixXd E = level.E;
    const double size = E.cwiseAbs().maxCoeff();
    EXPECT_LE((E - E.transpose()).cwiseAbs().maxCoeff(), 1e-14 * size);
    EXPECT_LE((E * level.null_space).cwiseAbs().maxCoeff(), 1e-12 * size);
    const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(E, Eigen::EigenvaluesOnly).eigenvalues();
    EXPECT_GT(eigenvalues[level.null_space.cols()], 1e-9 * size) << "a null space larger than stated";
    if (k == levels.finest()) continue;
    const auto& R = levels.steps[static_cast<std::size_t>(k)].R;
    const auto& fine = levels.levels[static_cast<std::size_t>(k + 1)];
    EXPECT_LE((MatrixXd(R.transpose() * fine.E * R) - E).cwiseAbs().maxCoeff(), 1e-12 * fine.E.coeffs().maxCoeff());
    expect_near(R * level.null_space, fine.null_space, 1e-13);
    if (!splines[0].has_mask())
      expect_near(level.weights, splines[static_cast<std::size_t>(k)].moments(), 1e-13 * level.weights.norm());
  }
}

TEST_P(BellForm, two_scale_relation_holds_and_moments_are_kept) {
  for (int k = 0; k < levels.finest(); ++k) {
    const VariationalScheme scheme(levels, k);
    const auto &coarse = levels.levels[static_cast<std::size_t>(k)],
               &fine = levels.levels[static_cast<std::size_t>(k + 1)];
    const auto& M = levels.steps[static_cast<std::size_t>(k)].M;
    const MatrixXd S = scheme.matrix();
    const double size = fine.E.coeffs().cwiseAbs().maxCoeff();
    EXPECT_LE((fine.E * S - MatrixXd(M.transpose() * coarse.E)).cwiseAbs().maxCoeff(), 1e-12 * size);
    expect_near(fine.weights * S, coarse.weights, 1e-10 * coarse.weights.norm());
    expect_near(S * coarse.null_space, fine.null_space, 1e-9);
    const int i = scheme.rows() / 3;
    expect_near(scheme.row(i), S.row(i).transpose(), 1e-10);
  }
}

TEST_P(BellForm, range_of_the_scheme_is_orthogonal_to_what_has_no_measurements) {
  const VariationalScheme scheme(levels, 1);
  const MatrixXd M = levels.steps[1].M;
  const VectorXd p = scheme.apply(random_coefficients(scheme.columns(), 1)), q = random_coefficients(scheme.rows(), 2);
  const VectorXd w = q - M.completeOrthogonalDecomposition().solve(M * q);
  ASSERT_LE((M * w).norm(), 1e-12 * q.norm());
  const auto& level = levels.levels[2];
  EXPECT_LE(std::abs(w.dot(level.E * p)), 1e-9 * std::sqrt(energy(level, w) * energy(level, p)));
}

// p_k^T E_k p_k = p_0^T E_0 (M_0 ... M_{k-1} p_k), which for k -> infinity is p_0^T E_0 N_0 p_0 with N_0 p_0 the
// coarse measurements of the limit.
TEST_P(BellForm, energies_are_those_of_the_coarse_measurements) {
  const auto p = subdivided(schemes(levels), random_coefficients(levels.levels[0].E.rows(), 4));
  for (int k = 1; k <= 2; ++k) {
    const double found = energy(levels.levels[static_cast<std::size_t>(k)], p[static_cast<std::size_t>(k)]);
    const VectorXd measured = measured_on_coarsest(levels, k, p[static_cast<std::size_t>(k)]);
    EXPECT_NEAR(found, p[0].dot(levels.levels[0].E * measured), 1e-9 * found);
  }
}

INSTANTIATE_TEST_SUITE_P(Domains, BellForm, testing::ValuesIn(test::bell_form_domains()),
                         [](const auto& named) { return named.param.name; });

TEST(VariationalScheme, says_what_is_wrong_with_its_input) {
  using testing::HasSubstr;
  const auto levels = natural_cubic_levels(4, 1);
  EXPECT_THAT(message_of<InvalidInput>([&] { VariationalScheme(levels, 1); }),
              HasSubstr("a step from 0 to 0, found 1"));
  EXPECT_THAT(message_of<InvalidInput>([&] { VariationalScheme(levels, 0); }),
              HasSubstr("expected 2 independent weights"));
  EXPECT_THAT(message_of<InvalidInput>([&] {
                VariationalScheme(levels, 0, {{0, 9}});
              }),
              HasSubstr("from 0 to 4, found 9"));
  EXPECT_THAT(message_of<InvalidInput>([&] {
                VariationalScheme(levels, 0, {{3, 3}});
              }),
              HasSubstr("depend on each other"));
  auto wrong = levels;
  wrong.steps[0].M.coeffRef(1, 2) = 2;
  EXPECT_THAT(message_of<InvalidInput>([&] {
                VariationalScheme(wrong, 0, {{0, 4}});
              }),
              HasSubstr("map the null space"));
}

}  // namespace
}  // namespace batten
