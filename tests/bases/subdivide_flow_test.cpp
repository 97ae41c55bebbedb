// SPDX-License-Identifier: MIT
#include <batten/bases/flow_basis.h>
#include <batten/bases/optimal_flow_masks.h>
#include <batten/bases/subdivide_flow.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double eps = std::numeric_limits<double>::epsilon();

FlowMasks<double> masks_of(Flow flow, FlowKind kind, int size) {
  return to_double(optimal_flow_masks(flow, kind, size).masks);
}

double largest(const ControlGrid& grid) { return grid.components[0].cwiseAbs().maxCoeff(); }

Eigen::MatrixXd random_matrix(int rows, int columns, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return number(random); });
}

StaggeredField random_field(int nx, int ny) {
  return {random_matrix(nx + 1, ny, 1), random_matrix(nx, ny + 1, 2), {3, -2}, 0.5};
}

/// u = ψ_y, v = -ψ_x of random values ψ at vertices: no cell has divergence.
StaggeredField divergence_free_field(int nx, int ny) {
  const Eigen::MatrixXd psi = random_matrix(nx + 1, ny + 1, 3);
  return {psi.rightCols(ny) - psi.leftCols(ny), psi.topRows(nx) - psi.bottomRows(nx)};
}

TEST(SubdividedFlow, puts_the_masks_where_they_belong) {
  const auto masks = masks_of(Flow::Slow, FlowKind::Book, 5);
  StaggeredField one{Eigen::MatrixXd::Zero(3, 2), Eigen::MatrixXd::Zero(2, 3), {10, 20}, 2};
  one.u(1, 0) = 1;  // at (12, 21)
  const StaggeredField fine = subdivided(masks, one, {.sides = FieldSides::Zero});
  EXPECT_EQ(fine.spacing, 1);
  double sum_u = 0, sum_v = 0;
  for (int j = 0; j < fine.u.cols(); ++j)
    for (int i = 0; i < fine.u.rows(); ++i) {  // x^e y^f is the wall at (12 + e, 21 + f)
      const double e = fine.start[0] + i - 12, f = fine.start[1] + j + 0.5 - 21;
      EXPECT_EQ(fine.u(i, j), masks.s11[(Index<2>{static_cast<int>(e), static_cast<int>(std::floor(f))})]);
      sum_u += std::abs(fine.u(i, j));
    }
  for (int j = 0; j < fine.v.cols(); ++j)
    for (int i = 0; i < fine.v.rows(); ++i) {
      const double e = fine.start[0] + i + 0.5 - 12, f = fine.start[1] + j - 21;
      EXPECT_EQ(fine.v(i, j), masks.s21[(Index<2>{static_cast<int>(std::floor(e)), static_cast<int>(f)})]);
      sum_v += std::abs(fine.v(i, j));
    }
  double all_u = 0, all_v = 0;  // nothing of the masks is missing
  for (double c : masks.s11.coefficients()) all_u += std::abs(c);
  for (double c : masks.s21.coefficients()) all_v += std::abs(c);
  EXPECT_NEAR(sum_u, all_u, 1e-13);
  EXPECT_NEAR(sum_v, all_v, 1e-13);
}

TEST(SubdividedFlow, is_symmetric_in_x_and_y) {
  const auto masks = masks_of(Flow::Perfect, FlowKind::Book, 5);
  const StaggeredField field = random_field(6, 4);
  const StaggeredField mirrored{field.v.transpose(), field.u.transpose(), {field.start[1], field.start[0]}, 0.5};
  const FlowSubdivisionOptions options{.levels = 2, .sides = FieldSides::Nearest};
  const StaggeredField fine = subdivided(masks, field, options), other = subdivided(masks, mirrored, options);
  EXPECT_LE((fine.u - other.v.transpose()).cwiseAbs().maxCoeff(), 100 * eps);
  EXPECT_LE((fine.v - other.u.transpose()).cwiseAbs().maxCoeff(), 100 * eps);
}

/// Every flow and kind, size 7.
class FlowScheme : public testing::TestWithParam<std::tuple<Flow, FlowKind>> {
protected:
  FlowMasks<double> masks(int size = 7) const {
    return masks_of(std::get<0>(GetParam()), std::get<1>(GetParam()), size);
  }
};

INSTANTIATE_TEST_SUITE_P(All, FlowScheme,
                         testing::Combine(testing::Values(Flow::Perfect, Flow::Slow),
                                          testing::Values(FlowKind::Book, FlowKind::Commuting)));

TEST_P(FlowScheme, reproduces_constants) {
  const StaggeredField field{Eigen::MatrixXd::Constant(10, 9, 2), Eigen::MatrixXd::Constant(9, 10, -3)};
  for (FieldSides sides : {FieldSides::Open, FieldSides::Nearest}) {
    const StaggeredField fine = subdivided(masks(), field, {.levels = 3, .sides = sides});
    EXPECT_LE((fine.u.array() - 2).abs().maxCoeff(), 1e-13);
    EXPECT_LE((fine.v.array() + 3).abs().maxCoeff(), 1e-13);
  }
}

TEST_P(FlowScheme, has_open_walls_among_those_of_any_sides) {
  const StaggeredField field = random_field(10, 9);
  const StaggeredField open = subdivided(masks(), field, {.levels = 2});
  const StaggeredField nearest = subdivided(masks(), field, {.levels = 2, .sides = FieldSides::Nearest});
  EXPECT_EQ(nearest.cells_x(), 40);
  EXPECT_EQ(nearest.cells_y(), 36);
  EXPECT_EQ(nearest.start, field.start);
  const auto inner = cropped(nearest, static_cast<int>(std::lround((open.start[0] - 3) / open.spacing)));
  EXPECT_EQ(inner.u, open.u);
  EXPECT_EQ(inner.v, open.v);
  EXPECT_EQ(inner.start, open.start);
}

/// Rounding: each velocity is a sum of fewer than 2 (size + 1)² products.
double divergence_rounding(const StaggeredField& fine) {
  return 200 * eps * std::max(fine.u.cwiseAbs().maxCoeff(), fine.v.cwiseAbs().maxCoeff()) / fine.spacing;
}

TEST(CommutingScheme, keeps_divergence_free_fields_so) {
  const StaggeredField field = divergence_free_field(8, 6);
  for (Flow flow : {Flow::Perfect, Flow::Slow})
    for (int size : {5, 9})
      for (FieldSides sides : {FieldSides::Nearest, FieldSides::Zero}) {
        const auto masks = masks_of(flow, FlowKind::Commuting, size);
        const int levels = 5;
        StaggeredField fine = subdivided(masks, field, {.levels = levels, .sides = sides});
        // outside, fields at rest meet moving walls, so only the region counts
        if (sides == FieldSides::Zero) fine = cropped(fine, reach_in_cells(masks) << levels);
        EXPECT_EQ(fine.cells_x(), 8 << levels);
        EXPECT_LE(largest(divergence(fine)), divergence_rounding(fine)) << size;
      }
}

TEST(CommutingScheme, passes_the_divergence_of_a_cell_to_its_children) {
  const StaggeredField field = random_field(5, 4);
  const auto coarse = divergence(field);
  for (Flow flow : {Flow::Perfect, Flow::Slow}) {
    const StaggeredField fine =
        subdivided(masks_of(flow, FlowKind::Commuting, 7), field, {.levels = 2, .sides = FieldSides::Nearest});
    const auto children = divergence(fine).components[0];
    for (int j = 0; j < children.cols(); ++j)
      for (int i = 0; i < children.rows(); ++i)
        EXPECT_NEAR(children(i, j), coarse.components[0](i / 4, j / 4), divergence_rounding(fine));
  }
}

TEST(BookScheme, rotates_at_coarse_vertices_only) {  // perfect flow: rot_fine = 4 rot_coarse there, elsewhere 0
  const StaggeredField field = random_field(10, 9);
  const StaggeredField fine = subdivided(masks_of(Flow::Perfect, FlowKind::Book, 7), field);
  const auto coarse = rotation(field), finer = rotation(fine);
  const Eigen::MatrixXd& values = finer.components[0];
  for (int j = 0; j < values.cols(); ++j)
    for (int i = 0; i < values.rows(); ++i) {
      const double x = (finer.start[0] - coarse.start[0]) / 0.5 + 0.5 * i;
      const double y = (finer.start[1] - coarse.start[1]) / 0.5 + 0.5 * j;
      const bool is_coarse = x == std::floor(x) && y == std::floor(y);
      EXPECT_NEAR(values(i, j), is_coarse ? 4 * coarse.components[0](static_cast<int>(x), static_cast<int>(y)) : 0,
                  1e-13);
    }
}

TEST(BookScheme, leaves_no_more_divergence_than_its_norm) {
  const auto optimal = optimal_flow_masks(Flow::Perfect, FlowKind::Book, 5);
  const double bound = optimal.divergence.convert_to<double>();
  double found = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    StaggeredField field{random_matrix(9, 8, seed), random_matrix(8, 9, seed + 100)};
    field.u = field.u.array().sign();
    field.v = field.v.array().sign();
    const StaggeredField fine = subdivided(to_double(optimal.masks), field);
    found = std::max(found, largest(divergence(fine)) * fine.spacing);
  }
  EXPECT_LE(found, bound * (1 + 1e-12));
  EXPECT_GE(found, bound / 4);  // random signs come near to the worst ones
}

TEST(SubdividedFlow, refuses_what_cannot_be) {
  const auto masks = masks_of(Flow::Perfect, FlowKind::Book, 9);
  const StaggeredField small = random_field(2, 2);
  EXPECT_THAT([&] { subdivided(masks, small); },
              ThrowsMessage<InvalidInput>(HasSubstr("is too small for these masks")));
  EXPECT_THAT([&] { subdivided(masks, small, {.levels = -1}); },
              ThrowsMessage<InvalidInput>(HasSubstr("levels must not be negative, found -1")));
  EXPECT_THAT([&] { subdivided(masks, small, {.levels = 20, .sides = FieldSides::Zero}); },
              ThrowsMessage<InvalidInput>(HasSubstr("more than 2^30 cells")));
}

}  // namespace
}  // namespace batten
