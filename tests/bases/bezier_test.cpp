// SPDX-License-Identifier: MIT
#include <batten/bases/bezier.h>
#include <batten/domains/errors.h>

#include <gtest/gtest.h>

namespace batten {
namespace {

Eigen::MatrixXd matrix(int n, std::initializer_list<double> entries) {
  Eigen::MatrixXd m(n, n);
  int k = 0;
  for (double e : entries) {
    m(k / n, k % n) = e;
    ++k;
  }
  return m;
}

TEST(Bezier, halves_have_the_printed_matrices) {
  // [Warren & Weimer 2001, sec. 1.2.4], exact in doubles
  const auto quadratic = casteljau_maps(2), cubic = casteljau_maps(3);
  EXPECT_EQ(quadratic.left, matrix(3, {1, 0, 0, .5, .5, 0, .25, .5, .25}));
  EXPECT_EQ(quadratic.right, matrix(3, {.25, .5, .25, 0, .5, .5, 0, 0, 1}));
  EXPECT_EQ(cubic.left, matrix(4, {1, 0, 0, 0, .5, .5, 0, 0, .25, .5, .25, 0, .125, .375, .375, .125}));
  EXPECT_EQ(cubic.right, matrix(4, {.125, .375, .375, .125, 0, .25, .5, .25, 0, 0, .5, .5, 0, 0, 0, 1}));
}

TEST(Bezier, halves_join_and_have_rows_that_sum_to_one) {
  for (int m = 0; m <= 53; ++m) {
    const auto maps = casteljau_maps(m);
    EXPECT_EQ(maps.left.row(m), maps.right.row(0));
    EXPECT_TRUE(maps.left.rowwise().sum().isOnes(1e-14));
  }
}

TEST(Bezier, maps_contract_the_edges_of_cubics_by_three_quarters) {
  // edges e_i = p_{i+1} - p_i of the halves in terms of those of the whole: D S = C D
  const auto maps = casteljau_maps(3);
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(3, 4);
  for (int i = 0; i < 3; ++i) D(i, i) = -1, D(i, i + 1) = 1;
  // p_i = Σ_{j<i} e_j + p_0: the columns of the summation matrix
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(4, 3);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j) sums(i, j) = 1;
  for (const auto& S : {maps.left, maps.right}) EXPECT_LE((D * S * sums).cwiseAbs().rowwise().sum().maxCoeff(), 0.75);
}

TEST(Bezier, basis_is_a_partition_of_unity_with_maxima_at_i_over_m) {
  const auto cubic = bernstein_basis(3, 0.25);
  EXPECT_NEAR(cubic[0], 27. / 64, 1e-16);
  EXPECT_NEAR(cubic[1], 27. / 64, 1e-16);
  EXPECT_NEAR(cubic[2], 9. / 64, 1e-16);
  EXPECT_NEAR(cubic[3], 1. / 64, 1e-16);
  for (double x : {0., 0.3, 1.}) EXPECT_NEAR(bernstein_basis(9, x).sum(), 1, 1e-15);
  for (int i = 1; i < 5; ++i) {
    const double peak = i / 5., at = bernstein_basis(5, peak)[i];
    EXPECT_GT(at, bernstein_basis(5, peak - 0.01)[i]);
    EXPECT_GT(at, bernstein_basis(5, peak + 0.01)[i]);
  }
}

TEST(Bezier, curve_starts_and_ends_in_its_polygon) {
  const Eigen::MatrixXd p{{3}, {-1}, {4}, {1}};
  EXPECT_EQ(bezier_point(p, 0)[0], 3);
  EXPECT_EQ(bezier_point(p, 1)[0], 1);
  EXPECT_DOUBLE_EQ(bezier_point(p, 0.5)[0], (3 - 3 + 12 + 1) / 8.);
  EXPECT_NEAR(bezier_point(p, 0.3)[0], (bernstein_basis(3, 0.3) * p)(0, 0), 1e-15);
}

TEST(Bezier, refuses_no_points_and_degrees_that_are_not_exact) {
  EXPECT_THROW(casteljau_maps(-1), InvalidInput);
  EXPECT_THROW(casteljau_maps(54), InvalidInput);
  EXPECT_THROW(bernstein_basis(-1, 0), InvalidInput);
  EXPECT_THROW(bezier_point(Eigen::MatrixXd(0, 2), 0.5), InvalidInput);
}

}  // namespace
}  // namespace batten
