// SPDX-License-Identifier: MIT
#include <batten/bases/box_spline.h>
#include <batten/bases/bspline_scheme.h>
#include <batten/bases/interpolatory_schemes.h>
#include <batten/bases/mask_text.h>
#include <batten/bases/optimal_mask.h>
#include <batten/bases/subdivide.h>
#include <batten/bases/subdivision_matrix.h>
#include <batten/domains/errors.h>

#include "../support/laws.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>

namespace batten {
namespace {

using test::random_vector;
using testing::HasSubstr;
using testing::ThrowsMessage;

const Directions linear = {{1, 0}, {0, 1}, {1, 1}};
const Directions zwart_powell = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}};
const Directions quartic = {{1, 0}, {1, 0}, {0, 1}, {0, 1}, {1, 1}, {1, 1}};

Eigen::MatrixXd random_values(int nx, int ny) {
  const auto v = random_vector(static_cast<std::size_t>(nx * ny), 5);
  return Eigen::Map<const Eigen::MatrixXd>(v.data(), nx, ny);
}

Mask2<double> mask_of(const Eigen::MatrixXd& values) {
  return {{0, 0},
          {static_cast<int>(values.rows()), static_cast<int>(values.cols())},
          std::vector<double>(values.data(), values.data() + values.size())};
}

TEST(SubdividedGrid, values_are_the_products_of_masks) {
  const auto ternary = tensor_product(bspline_scheme(3, 3), ternary_four_point_scheme());
  for (const auto& scheme : {box_scheme(linear), box_scheme(zwart_powell), box_scheme(quartic), butterfly_scheme(),
                             quad_interpolatory_scheme(), ternary, box_scheme({{2, 0}, {0, 1}})})
    for (const auto& [nx, ny] : {std::pair{1, 1}, {5, 3}, {30, 17}}) {
      const auto values = random_values(nx, ny);
      auto expected = mask_of(values);
      for (int k = 0; k < 2; ++k) expected = scheme.mask() * upsampled(expected, scheme.arity());
      const auto fine = subdivided(scheme, {.components = {values}}, {.levels = 2});
      const int x = static_cast<int>(std::lround(fine.start[0] / fine.spacing[0]));
      const int y = static_cast<int>(std::lround(fine.start[1] / fine.spacing[1]));
      ASSERT_EQ((Index<2>{x, y}), expected.first()) << scheme.name();
      double error = 0;
      for (int j = 0; j < fine.components[0].cols(); ++j)
        for (int i = 0; i < fine.components[0].rows(); ++i)
          error = std::max(error, std::abs(fine.components[0](i, j) - expected[{x + i, y + j}]));
      EXPECT_LT(error, 1e-14) << scheme.name();
    }
}

TEST(SubdividedGrid, delta_tends_to_the_exact_box_splines) {
  // coefficients of level k are n at the middle of the support of their fine function, to O(h^2)
  const auto fine =
      subdivided(centred(box_scheme(quartic)), {.components = {Eigen::MatrixXd::Ones(1, 1)}}, {.levels = 6});
  const auto at = [&](double x, double y) {
    return fine.components[0](std::lround((x - 2 - fine.start[0]) / fine.spacing[0]),
                              std::lround((y - 2 - fine.start[1]) / fine.spacing[1]));
  };
  EXPECT_NEAR(at(2, 2), 0.5, 1e-3);
  EXPECT_NEAR(at(1, 1), 1. / 12, 1e-3);
  EXPECT_NEAR(at(1.5, 1.5), 21. / 64, 1e-3);
}

TEST(SubdividedGrid, alternating_data_give_zero_under_zwart_powell) {
  // the linear dependence of the translates [Warren & Weimer 2001, sec. 2.2.4]
  Eigen::MatrixXd values(6, 8);
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 6; ++i) values(i, j) = (i + j) % 2 == 0 ? 1 : -1;
  const auto fine = subdivided(box_scheme(zwart_powell), {.components = {values}},
                               {.levels = 2, .x = Ends::Periodic, .y = Ends::Periodic});
  EXPECT_EQ(fine.components[0].cwiseAbs().maxCoeff(), 0);
}

TEST(SubdividedGrid, sides_may_differ) {
  // a strip closed in x and open in y, of two components
  const Eigen::MatrixXd a = random_values(6, 9), b = a.cwiseAbs();
  const auto scheme = box_scheme(quartic);
  const auto fine = subdivided(scheme, {.components = {a, b}}, {.levels = 2, .x = Ends::Periodic, .y = Ends::Open});
  ASSERT_EQ(fine.components.size(), 2u);
  EXPECT_EQ(fine.components[0].rows(), 24);
  const Eigen::MatrixXd many = b.replicate(9, 1);
  const auto wide = subdivided(scheme, {.components = {many}}, {.levels = 2});
  const auto x = std::lround((fine.start[0] - wide.start[0]) / fine.spacing[0]) + 4 * 24;
  const auto y = std::lround((fine.start[1] - wide.start[1]) / fine.spacing[1]);
  const Eigen::MatrixXd expected = wide.components[0].block(x, y, 24, fine.components[1].cols());
  EXPECT_LT((fine.components[1] - expected).cwiseAbs().maxCoeff(), 1e-15);
  // the limit is determined where all of its functions are: y from 3 to 9
  const auto finest = subdivided(scheme, {.components = {a}}, {.levels = 7, .x = Ends::Periodic, .y = Ends::Open});
  EXPECT_NEAR(finest.start[1], 3, 0.05);
  EXPECT_NEAR(finest.start[1] + finest.spacing[1] * static_cast<double>(finest.components[0].cols() - 1), 9, 0.05);
}

/// The values mirrored at the ends of both axes, so far that the mask of some levels does not reach beyond.
Eigen::MatrixXd mirrored(const Eigen::MatrixXd& values, int beyond) {
  const auto nx = static_cast<int>(values.rows()), ny = static_cast<int>(values.cols());
  const auto turned = [](int i, int n) {
    while (i < 0 || i >= n) i = i < 0 ? -i : 2 * (n - 1) - i;
    return i;
  };
  Eigen::MatrixXd all(nx + 2 * beyond, ny + 2 * beyond);
  for (int j = 0; j < ny + 2 * beyond; ++j)
    for (int i = 0; i < nx + 2 * beyond; ++i) all(i, j) = values(turned(i - beyond, nx), turned(j - beyond, ny));
  return all;
}

TEST(SubdividedGrid, reflection_is_subdivision_of_mirrored_data) {  // [Warren & Weimer 2001, sec. 6.4.2]
  const auto cubic = centred(bspline_scheme(4));
  for (const auto& scheme : {quad_interpolatory_scheme(), tensor_product(cubic, four_point_scheme())})
    for (const auto& [nx, ny] : {std::pair{2, 3}, {5, 4}, {20, 33}}) {
      const auto values = random_values(nx, ny);
      const GridSubdivisionOptions options{.levels = 2, .x = Ends::Reflect, .y = Ends::Reflect};
      const auto fine = subdivided(scheme, {.components = {values}}, options);
      const auto wide = subdivided(scheme, {.components = {mirrored(values, 8)}}, {.levels = 2});
      ASSERT_EQ(fine.components[0].rows(), 4 * (nx - 1) + 1);
      ASSERT_EQ(fine.components[0].cols(), 4 * (ny - 1) + 1);
      EXPECT_EQ(fine.start, (std::array{0., 0.}));
      const auto x = std::lround(-wide.start[0] / wide.spacing[0]) + 32,
                 y = std::lround(-wide.start[1] / wide.spacing[1]) + 32;
      const Eigen::MatrixXd expected =
          wide.components[0].block(x, y, fine.components[0].rows(), fine.components[0].cols());
      EXPECT_LT((fine.components[0] - expected).cwiseAbs().maxCoeff(), 1e-14);
    }
}

TEST(SubdividedGrid, reflection_needs_a_symmetric_mask) {
  const ControlGrid grid{.components = {random_values(4, 4)}};
  EXPECT_THAT([&] { subdivided(box_scheme(quartic), grid, {.levels = 1, .x = Ends::Reflect}); },
              ThrowsMessage<InvalidInput>(HasSubstr("symmetric about 0 in x")));
  const auto dual = tensor_product(centred(bspline_scheme(4)), centred(bspline_scheme(3)));
  EXPECT_THAT([&] { subdivided(dual, grid, {.levels = 1, .y = Ends::Reflect}); },
              ThrowsMessage<InvalidInput>(HasSubstr("symmetric about 0 in y")));
}

TEST(SubdividedGrid, large_masks_are_summed_like_small_ones) {
  // the kernel adds rows that share their weights; a random mask has none of them
  const auto large = custom_scheme(optimal_mask(1, 9, {.precision = 0}).mask);
  auto coefficients = random_vector(81, 3);
  double sum = 0;
  for (double c : coefficients) sum += c;
  for (double& c : coefficients) c *= 4 / sum;
  const Scheme2 random("random", Mask2<double>({-4, -4}, {9, 9}, std::move(coefficients)));
  for (const auto& scheme : {large, random})
    for (const auto& [nx, ny] : {std::pair{1, 1}, {7, 3}, {40, 21}}) {
      const auto values = random_values(nx, ny);
      const auto expected = scheme.mask() * upsampled(mask_of(values), 2);
      const auto fine = subdivided(scheme, {.components = {values}}, {.levels = 1});
      double error = 0;
      for (int j = 0; j < fine.components[0].cols(); ++j)
        for (int i = 0; i < fine.components[0].rows(); ++i)
          error = std::max(error, std::abs(fine.components[0](i, j) - expected[{i - 4, j - 4}]));
      EXPECT_LT(error, 1e-13);
    }
}

TEST(SubdividedGrid, values_have_the_same_bits_for_every_number_of_threads) {
  const auto values = random_values(301, 203);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const auto one = subdivided(butterfly_scheme(), {.components = {values}}, {.levels = 2});
  omp_set_num_threads(3);
  const auto three = subdivided(butterfly_scheme(), {.components = {values}}, {.levels = 2});
  omp_set_num_threads(before);
  EXPECT_TRUE(one.components[0] == three.components[0]);
}

TEST(SubdividedGrid, is_what_the_sparse_matrix_gives) {
  for (Ends ends : {Ends::Zero, Ends::Periodic, Ends::Open, Ends::Reflect}) {
    const auto scheme = ends == Ends::Reflect ? quad_interpolatory_scheme() : butterfly_scheme();
    const auto values = random_values(7, 9);
    const auto fine = subdivided(scheme, {.components = {values}}, {.levels = 1, .x = ends, .y = ends});
    const Eigen::VectorXd expected = subdivision_matrix(scheme, GridSize{7, 9}, ends) * values.reshaped();
    ASSERT_EQ(fine.components[0].size(), expected.size());
    EXPECT_LT((fine.components[0].reshaped() - expected).cwiseAbs().maxCoeff(), 1e-15);
  }
}

TEST(SubdividedGrid, data_that_cannot_be_are_refused) {
  const auto scheme = butterfly_scheme();
  EXPECT_THROW(subdivided(scheme, ControlGrid{}), InvalidInput);
  EXPECT_THAT(
      [&] {
        return subdivided(scheme, {.components = {random_values(3, 4), random_values(4, 3)}});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("same size, found 4 x 3 and 3 x 4")));
  EXPECT_THAT(
      [&] {
        return subdivided(scheme, {.components = {random_values(9, 2)}},
                          {.levels = 5, .x = Ends::Open, .y = Ends::Open});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("too few in y")));
  EXPECT_THROW(subdivided(scheme, {.components = {random_values(3, 4)}}, {.levels = -1}), InvalidInput);
  EXPECT_THROW(subdivided(scheme, {.components = {Eigen::MatrixXd::Constant(2, 2, NAN)}}), InvalidInput);
}

}  // namespace
}  // namespace batten
