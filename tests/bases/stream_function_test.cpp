// SPDX-License-Identifier: MIT
#include <batten/bases/stream_function.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return number(random); });
}

/// The flow of ψ at vertices.
StaggeredField flow_of(const Eigen::MatrixXd& psi, double spacing) {
  const Eigen::Index nx = psi.rows() - 1, ny = psi.cols() - 1;
  return {(psi.rightCols(ny) - psi.leftCols(ny)) / spacing,
          (psi.topRows(nx) - psi.bottomRows(nx)) / spacing,
          {-3, 5},
          spacing};
}

StaggeredField difference(const StaggeredField& a, const StaggeredField& b) {
  return {a.u - b.u, a.v - b.v, a.start, a.spacing};
}

/// Σ over cells of the squares at their four walls.
double squares(const StaggeredField& f) {
  const auto nx = f.cells_x(), ny = f.cells_y();
  return f.u.topRows(nx).squaredNorm() + f.u.bottomRows(nx).squaredNorm() + f.v.leftCols(ny).squaredNorm() +
         f.v.rightCols(ny).squaredNorm();
}

const std::vector<std::pair<int, int>> sizes = {{1, 1}, {2, 1}, {1, 7}, {12, 10}, {31, 64}, {97, 39}};

TEST(StreamFunction, is_the_one_that_a_field_comes_from) {
  for (const auto& [nx, ny] : sizes) {
    const Eigen::MatrixXd psi = random_matrix(nx + 1, ny + 1, 1);
    const ControlGrid found = stream_function(flow_of(psi, 0.25));
    ASSERT_EQ(found.components.size(), 1u);
    EXPECT_EQ(found.start, (std::array<double, 2>{-3, 5}));
    EXPECT_EQ(found.spacing, (std::array<double, 2>{0.25, 0.25}));
    EXPECT_EQ(found.components[0](0, 0), 0);
    // Entries of the inverse sum up to less than the square of the size.
    EXPECT_LE((found.components[0].array() - (psi.array() - psi(0, 0))).abs().maxCoeff(), 2.2e-16 * 10 * (nx + ny))
        << nx << " x " << ny;
  }
}

TEST(StreamFunction, is_the_nearest_where_there_is_divergence) {
  for (const auto& [nx, ny] : sizes) {
    const StaggeredField field{random_matrix(nx + 1, ny, 2), random_matrix(nx, ny + 1, 3), {0, 0}, 0.5};
    const Eigen::MatrixXd psi = stream_function(field).components[0];
    const double least = squares(difference(field, flow_of(psi, 0.5)));
    // A quadratic function is least where it grows alike on both sides.
    for (unsigned seed : {4, 5, 6}) {
      const Eigen::MatrixXd other = random_matrix(nx + 1, ny + 1, seed);
      const double more = squares(difference(field, flow_of(psi + other, 0.5)));
      const double less = squares(difference(field, flow_of(psi - other, 0.5)));
      EXPECT_GT(more, least);
      EXPECT_NEAR(more - least, less - least, 1e-12 * more);
    }
  }
}

TEST(StreamFunction, leaves_a_gradient) {
  // u = φ(right) - φ(left), v = φ(above) - φ(below), φ in the cells and beyond the sides the opposite of that inside:
  // each cell counting its own walls, it is orthogonal to every flow without divergence.
  const int nx = 9, ny = 6;
  Eigen::MatrixXd phi = Eigen::MatrixXd::Zero(nx + 2, ny + 2);
  phi.block(1, 1, nx, ny) = random_matrix(nx, ny, 7);
  phi.row(0) = -phi.row(1);
  phi.row(nx + 1) = -phi.row(nx);
  phi.col(0) = -phi.col(1);
  phi.col(ny + 1) = -phi.col(ny);
  const StaggeredField field{(phi.bottomRows(nx + 1) - phi.topRows(nx + 1)).middleCols(1, ny),
                             (phi.rightCols(ny + 1) - phi.leftCols(ny + 1)).middleRows(1, nx)};
  EXPECT_LE(stream_function(field).components[0].cwiseAbs().maxCoeff(), 1e-14);
}

TEST(StreamFunction, needs_a_field) {
  EXPECT_THAT(
      [] {
        stream_function({Eigen::MatrixXd::Zero(3, 3), Eigen::MatrixXd::Zero(3, 3)});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("stream_function: u must have (nx+1) x ny values")));
}

}  // namespace
}  // namespace batten
