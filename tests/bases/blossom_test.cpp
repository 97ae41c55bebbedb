// SPDX-License-Identifier: MIT
#include <batten/bases/blossom.h>

#include "../support/dense.h"
#include <gtest/gtest.h>

namespace batten {
namespace {

TEST(Blossom, of_one_position_repeated_is_the_value) {
  for (int degree : {1, 2, 3, 5}) {
    const SplineBasis basis(Interval(0, 1, 7), degree);
    for (double t : {0., 0.3, 1., 3.5, 6.9, 7.}) {
      const auto value = basis.at(t),
                 found = blossom(basis, t, std::vector<double>(static_cast<std::size_t>(degree), t));
      for (std::size_t j = 0; j <= static_cast<std::size_t>(degree); ++j)
        EXPECT_NEAR(found.values[j], value.values[j], 1e-14);
    }
  }
}

TEST(Blossom, of_t_cubed_is_the_product_of_the_positions) {
  // t³ in a cubic basis has blossoms of its own knots as coefficients: their products
  const SplineBasis basis(Interval(0, 6, 6), 3);
  const auto at = [](int i) { return static_cast<double>(std::clamp(i, 0, 6)); };
  std::vector<double> c;
  for (int i = 0; i < basis.size(); ++i) c.push_back(at(i - 2) * at(i - 1) * at(i));
  const std::vector<double> positions = {2.25, 2.5, 3.75};
  const auto local = blossom(basis, 2.6, positions);
  double found = 0;
  for (int j = 0; j <= 3; ++j)
    found += local.values[static_cast<std::size_t>(j)] * c[static_cast<std::size_t>(local.first + j)];
  EXPECT_NEAR(found, 2.25 * 2.5 * 3.75, 1e-12);
}

// R of three halvings, from exact rules, row by row; on the finest level and on coarser ones with an odd last cell.
TEST(RefinedCoefficient, is_a_row_of_the_refinement) {
  for (int degree : {2, 3})
    for (int cells : {5, 8}) {
      SplineBasis fine(Interval(0, 1, 8 * cells), degree);
      Eigen::MatrixXd refinement = Eigen::MatrixXd::Identity(fine.size(), fine.size());
      SplineBasis level = fine;
      for (int k = 0; k < 3; ++k) {
        refinement = (refinement * test::dense(level.coarser().refinement(level))).eval();
        level = level.coarser();
      }
      const SplineBasis basis(Interval(0, 1, cells), degree);
      const auto greville = refined_greville(basis, 0.125);
      ASSERT_EQ(static_cast<int>(greville.size()), fine.size());
      const auto expected = fine.greville();
      for (int i = 0; i < fine.size(); ++i) {
        EXPECT_NEAR(greville[static_cast<std::size_t>(i)] / cells, expected[static_cast<std::size_t>(i)], 1e-14);
        const auto row = refined_coefficient(basis, greville[static_cast<std::size_t>(i)], 0.125);
        Eigen::VectorXd found = Eigen::VectorXd::Zero(basis.size());
        for (int j = 0; j <= degree; ++j) found[row.first + j] = row.values[static_cast<std::size_t>(j)];
        EXPECT_LT((found - refinement.row(i).transpose()).cwiseAbs().maxCoeff(), 1e-13) << degree << " " << i;
        EXPECT_GE(found.minCoeff(), -1e-15);
      }
    }
}

TEST(RefinedCoefficient, sees_coarser_levels_through_their_refinement) {
  const SplineBasis basis(Interval(0, 1, 11), 3), coarse = basis.coarser();
  const Eigen::MatrixXd refinement = test::dense(coarse.refinement(basis));
  for (const double g : refined_greville(basis, 0.125)) {
    const auto fine = refined_coefficient(basis, g, 0.125), found = refined_coefficient(coarse, g, 0.125);
    Eigen::VectorXd row = Eigen::VectorXd::Zero(basis.size()), coarse_row = Eigen::VectorXd::Zero(coarse.size());
    for (int j = 0; j <= 3; ++j) {
      row[fine.first + j] = fine.values[static_cast<std::size_t>(j)];
      coarse_row[found.first + j] = found.values[static_cast<std::size_t>(j)];
    }
    EXPECT_LT((refinement.transpose() * row - coarse_row).cwiseAbs().maxCoeff(), 1e-13) << g;
  }
}

}  // namespace
}  // namespace batten
