// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/energy_levels.h>
#include <batten/fem/multiresolution.h>

#include "../support/variational_domains.h"
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace batten {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Matrix = MeasurementMatrix::Matrix;

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.); }

void expect_orthogonal_and_lossless(const Multiresolution& splitter, const Eigen::SparseMatrix<double>& E,
                                    const VectorXd& q) {
  const auto analysis = splitter.analyse(q);
  const double energy = q.dot(E * q);
  EXPECT_LE((splitter.synthesise(analysis) - q).norm(), 1e-10 * q.norm());
  EXPECT_NEAR(sum(splitter.energies(analysis)), energy, 1e-9 * energy);
  VectorXd before = splitter.approximation(analysis, 0);
  const VectorXd first = before;
  Eigen::Index numbers = analysis.coarse.size();
  for (int k = 1; k <= splitter.levels(); ++k) {
    const VectorXd next = splitter.approximation(analysis, k), r = next - before;
    EXPECT_NEAR(r.dot(E * first), 0, 1e-9 * energy) << "r_" << k - 1 << " and q_0";
    EXPECT_NEAR(r.dot(E * before), 0, 1e-9 * energy) << "r_" << k - 1 << " and q_" << k - 1;
    numbers += analysis.details[static_cast<std::size_t>(k - 1)].size();
    before = next;
  }
  EXPECT_EQ(numbers, q.size());
}

/// Energies and measurements of natural cubic splines in their values: A = E N^-1 on the finest grid, every second
/// value.
struct NaturalCubics {
  NaturalCubics(int cells, int steps, double length) {
    const auto levels = natural_cubic_levels(cells, steps);
    const Eigen::Index n = levels.levels.back().E.rows();
    MatrixXd N = MatrixXd::Zero(n, n);
    N(0, 0) = N(n - 1, n - 1) = 1;
    for (Eigen::Index i = 1; i + 1 < n; ++i) N.row(i).segment(i - 1, 3) << 1. / 6, 2. / 3, 1. / 6;
    const MatrixXd dense = levels.levels.back().E * N.inverse() * std::pow(cells / length, 3);
    A = (0.5 * (dense + dense.transpose())).sparseView();
    for (const auto& step : levels.steps) M.emplace_back(step.M);
  }
  Eigen::SparseMatrix<double> A;
  std::vector<Matrix> M;
};

// Figure 6.8: sin on [0, 2π] sampled on the multiples of π / 32; q_5, q_3, q_1, q_0 interpolate it on those of π / 32,
// π / 8, π / 2 and π.
TEST(Multiresolution, splits_the_sine_of_figure_6_8) {
  const NaturalCubics spline(2, 5, 2 * M_PI);
  VectorXd q(65);
  for (int i = 0; i < 65; ++i) q[i] = std::sin(M_PI / 32 * i);
  const Multiresolution splitter(spline.A, spline.M);
  expect_orthogonal_and_lossless(splitter, spline.A, q);
  const auto analysis = splitter.analyse(q);
  const auto energies = splitter.energies(analysis);
  EXPECT_NEAR(energies[0], 0, 1e-12);  // sin is 0 at the multiples of π
  // The natural spline through 0, 1, 0, -1, 0 with spacing h is odd about its middle: second derivatives 0, -m, 0, m, 0
  // with 4 m = 6 · 2 / h², energy 2 · 2 h m² / 3.
  const double h = M_PI / 2, m = 3 / (h * h);
  EXPECT_NEAR(energies[0] + energies[1], 4 * h * m * m / 3, 1e-9);
  EXPECT_NEAR(sum(energies), M_PI, 2e-4);  // ∫ sin² = π, and sin'' is 0 at the ends as the spline's
  for (int k = 0; k <= 5; ++k) {
    const VectorXd part = splitter.approximation(analysis, k);
    for (int i = 0; i <= 64; i += 32 >> k) EXPECT_NEAR(part[i], q[i], 1e-12);
  }
}

TEST(Multiresolution, keeps_the_exact_energy_of_what_compression_leaves_out) {
  const NaturalCubics spline(4, 4, 1);
  VectorXd q(65);
  for (int i = 0; i < 65; ++i) q[i] = std::abs(i - 21.) / 64;  // a kink
  const Multiresolution splitter(spline.A, spline.M);
  const auto analysis = splitter.analyse(q);
  const auto all = compress(splitter, analysis, 0), few = compress(splitter, analysis, 1e-4);
  EXPECT_EQ(all.numbers, 65u);
  EXPECT_NEAR(all.energy_error, 0, 1e-12);
  EXPECT_LT(few.numbers, 40u);
  const VectorXd error = splitter.synthesise(few.kept) - q;
  EXPECT_NEAR(error.dot(spline.A * error), few.energy_error, 1e-9 * q.dot(spline.A * q));
  EXPECT_GT(few.energy_error, 0);
}

/// Averages over cells from those over half-size cells.
Matrix averages_of_averages(const SplineLevel& coarse, const SplineLevel& fine) {
  Matrix M(coarse.x().cells() * coarse.y().cells(), fine.x().cells() * fine.y().cells());
  for (int j = 0; j < fine.y().cells(); ++j)
    for (int i = 0; i < fine.x().cells(); ++i) {
      const int I = fine.x().breakpoints().parent(i), J = fine.y().breakpoints().parent(j);
      const auto share = [](const KnotSplines& f, const KnotSplines& c, int a, int A) {
        return f.breakpoints().width(a) / c.breakpoints().width(A);
      };
      M.insert(I + J * coarse.x().cells(), i + j * fine.x().cells()) =
          share(fine.x(), coarse.x(), i, I) * share(fine.y(), coarse.y(), j, J);
    }
  return M;
}

TEST(Multiresolution, is_lossless_and_orthogonal_in_two_dimensions) {
  auto domain = test::variational_domain(Energy::membrane(), 1, 13, 16, false);
  domain.coefficient = test::rough(208, 1000, 2);
  const auto levels = spline_levels(domain, 3);
  const std::vector<Matrix> M = {averages_of_averages(levels[0], levels[1]), averages_of_averages(levels[1], levels[2]),
                                 measurement_matrix(levels[2], levels[3], Measurement::CellAverages).M};
  const auto E = levels[3].energy();
  expect_orthogonal_and_lossless({E, M}, E, test::random_coefficients(E.rows(), 1));

  const auto plates = spline_levels(test::variational_domain(Energy::thin_plate(), 2, 16, 8), 2);
  const EnergyLevels bell = energy_levels(plates);
  const auto& finest = bell.levels[2].E;
  expect_orthogonal_and_lossless({finest, {Matrix(bell.steps[0].M), Matrix(bell.steps[1].M)}}, finest,
                                 test::random_coefficients(finest.rows(), 2));
}

TEST(Multiresolution, says_what_is_wrong_with_its_input) {
  const NaturalCubics spline(2, 2, 1);
  EXPECT_THROW(Multiresolution(spline.A, {}), InvalidInput);
  EXPECT_THROW(Multiresolution(spline.A, {spline.M[1], spline.M[0]}), InvalidInput);
}

}  // namespace
}  // namespace batten
