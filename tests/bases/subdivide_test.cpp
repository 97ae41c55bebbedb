// SPDX-License-Identifier: MIT
#include <batten/bases/bspline_scheme.h>
#include <batten/bases/interpolatory_schemes.h>
#include <batten/bases/mask_text.h>
#include <batten/bases/subdivide.h>
#include <batten/bases/subdivision_matrix.h>
#include <batten/bases/tension_scheme.h>
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

ControlPolygon polygon(std::initializer_list<double> values) {
  ControlPolygon p{.points = Eigen::MatrixXd(static_cast<Eigen::Index>(values.size()), 1)};
  std::copy(values.begin(), values.end(), p.points.data());
  return p;
}

ControlPolygon random_polygon(int n, int components) {
  const auto v = random_vector(static_cast<std::size_t>(n * components), 11);
  return {.points = Eigen::Map<const Eigen::MatrixXd>(v.data(), n, components)};
}

void expect_points(const ControlPolygon& p, const Mask<Rational>& expected, int first) {
  for (Eigen::Index i = 0; i < p.points.rows(); ++i)
    EXPECT_EQ(p.points(i, 0), static_cast<double>(expected[first + static_cast<int>(i)])) << i;
}

TEST(Subdivided, data_are_those_of_the_book) {
  // p_0 = 1 + 3x + 2x^2 + 5x^3 + 6x^4 [Warren & Weimer 2001, sec. 2.1.3], exact in doubles
  const auto p = polygon({1, 3, 2, 5, 6});
  const auto linear = subdivided(bspline_scheme(2), p);
  ASSERT_EQ(linear.points.rows(), 11);
  expect_points(linear, parse_mask("1/2,1,2,3,5/2,2,7/2,5,11/2,6,3"), 0);
  const auto twice = subdivided(bspline_scheme(2), p, {.levels = 2});
  ASSERT_EQ(twice.points.rows(), 23);
  expect_points(twice,
                parse_mask("1/4,1/2,3/4,1,3/2,2,5/2,3,11/4,5/2,9/4,2,11/4,7/2,17/4,5,21/4,11/2,23/4,6,9/2,3,3/2"), 0);
  const auto cubic = subdivided(bspline_scheme(4), p);
  ASSERT_EQ(cubic.points.rows(), 13);
  expect_points(cubic, parse_mask("1/8,1/2,9/8,2,21/8,5/2,5/2,7/2,19/4,11/2,41/8,3,3/4"), 0);
}

TEST(Subdivided, delta_gives_samples_of_the_hat_function) {
  const auto hat = subdivided(centred(bspline_scheme(2)), polygon({1}), {.levels = 5});
  ASSERT_EQ(hat.points.rows(), 63);
  for (Eigen::Index i = 0; i < 63; ++i) {
    const double x = hat.start + static_cast<double>(i) * hat.spacing;
    EXPECT_EQ(hat.points(i, 0), 1 - std::abs(x));
  }
}

TEST(Subdivided, points_are_the_products_of_masks_for_all_arities_widths_and_sizes) {
  for (const auto& scheme : {bspline_scheme(1), bspline_scheme(2), bspline_scheme(5), bspline_scheme(9),
                             bspline_scheme(24), bspline_scheme(3, 3), bspline_scheme(8, 3), four_point_scheme(),
                             deslauriers_dubuc_scheme(16), ternary_four_point_scheme()})
    for (int n : {1, 2, 7, 700})
      for (int levels : {0, 1, 3}) {
        const auto v = random_vector(static_cast<std::size_t>(n), 4);
        Mask<double> expected(0, v);
        for (int k = 0; k < levels; ++k) expected = scheme.mask() * upsampled(expected, scheme.arity());
        const auto range = subdivided_range(scheme, n, {.levels = levels});
        std::vector<double> found(static_cast<std::size_t>(range.size()));
        subdivide_into(scheme, v, {.levels = levels}, found);
        ASSERT_EQ(range.begin, expected.first()[0]) << scheme.name();
        double error = 0;
        for (std::ptrdiff_t i = 0; i < range.size(); ++i)
          error = std::max(error,
                           std::abs(found[static_cast<std::size_t>(i)] - expected[static_cast<int>(range.begin + i)]));
        EXPECT_LT(error, 1e-14) << scheme.name() << " " << n << " " << levels;
      }
}

TEST(Subdivided, closed_polygons_repeat) {
  for (const auto& scheme : {bspline_scheme(4), deslauriers_dubuc_scheme(8), ternary_four_point_scheme()}) {
    const auto p = random_polygon(5, 2);
    ControlPolygon many{.points = p.points.replicate(40, 1)};
    const auto closed = subdivided(scheme, p, {.levels = 3, .ends = Ends::Periodic});
    const auto open = subdivided(scheme, many, {.levels = 3, .ends = Ends::Zero});
    const auto period = closed.points.rows();
    EXPECT_EQ(period, 5 * std::lround(std::pow(scheme.arity(), 3)));
    const auto start = std::lround((closed.start - open.start) / open.spacing) + 20 * period;
    EXPECT_LT((closed.points - open.points.middleRows(start, period)).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(Subdivided, open_polygons_give_what_they_determine) {
  // cubic on 0 .. 4: new points 3 .. 9 in the convention of support [0, 4]; the limit on [3, 5]
  const auto p = polygon({1, 3, 2, 5, 6});
  const auto open = subdivided(bspline_scheme(4), p, {.levels = 1, .ends = Ends::Open});
  ASSERT_EQ(open.points.rows(), 7);
  EXPECT_EQ(open.start, 1.5);
  expect_points(open, parse_mask("2,21/8,5/2,5/2,7/2,19/4,11/2", 3), 3);
  const auto fine = subdivided(bspline_scheme(4), p, {.levels = 12, .ends = Ends::Open});
  EXPECT_NEAR(fine.start, 3, 1e-3);
  EXPECT_NEAR(fine.start + fine.spacing * static_cast<double>(fine.points.rows() - 1), 5, 1e-3);
  EXPECT_NEAR(fine.points(0, 0), 2.5, 1e-2);  // limit values 5/2 at 3 and 14/3 at 5
  // the four-point scheme keeps the second and the last but one point
  const auto four = subdivided(four_point_scheme(), p, {.levels = 1, .ends = Ends::Open});
  ASSERT_EQ(four.points.rows(), 5);
  EXPECT_EQ(four.start, 1);
  EXPECT_EQ(four.points(0, 0), 3);
  EXPECT_EQ(four.points(4, 0), 5);
  EXPECT_EQ(four.points(1, 0), (-1 + 9 * 3 + 9 * 2 - 5) / 16.);
}

TEST(Subdivided, limits_of_the_cubic_are_those_of_the_book) {
  // p(0 .. 8) = 0, 1/6, 7/6, 5/2, 8/3, 14/3, 29/6, 1, 0; control points err by h^2/6 |p''|, |p''| <= 13
  const int levels = 12;
  const auto fine = subdivided(bspline_scheme(4), polygon({1, 3, 2, 5, 6}), {.levels = levels});
  const std::vector<double> limits = {0, 1. / 6, 7. / 6, 2.5, 8. / 3, 14. / 3, 29. / 6, 1, 0};
  for (std::size_t x = 1; x < 8; ++x) {
    const auto row = (static_cast<Eigen::Index>(x) << levels) - 2;  // the B-spline that is centred at x
    EXPECT_NEAR(fine.points(row, 0), limits[x], 13. / 6 / (1 << 24));
  }
}

TEST(Subdivided, parameters_of_centred_schemes_do_not_drift) {
  // linear data stay linear at their own parameters
  for (int m : {2, 3, 4, 5, 6})
    for (int arity : {2, 3}) {
      ControlPolygon p = polygon({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
      p.start = 10;
      p.spacing = 0.5;
      const auto fine = subdivided(centred(bspline_scheme(m, arity)), p, {.levels = 3, .ends = Ends::Open});
      for (Eigen::Index i = 0; i < fine.points.rows(); ++i)
        EXPECT_NEAR(10 + 0.5 * fine.points(i, 0), fine.start + fine.spacing * static_cast<double>(i), 1e-13) << m;
    }
}

TEST(Subdivided, diamond_becomes_a_circle_under_tension) {
  ControlPolygon p{.points = (Eigen::MatrixXd(4, 2) << 1, 0, 0, 1, -1, 0, 0, -1).finished()};
  const auto fine = subdivided(tension_scheme(0), p, {.levels = 10, .ends = Ends::Periodic});
  ASSERT_EQ(fine.points.rows(), 4096);
  const Eigen::VectorXd radii = fine.points.rowwise().norm();
  EXPECT_LT(radii.maxCoeff() - radii.minCoeff(), 1e-14);
  // in two runs, the second of which continues at its level
  const auto half = subdivided(tension_scheme(0), p, {.levels = 4, .ends = Ends::Periodic});
  const auto rest = subdivided(tension_scheme(0), half, {.levels = 6, .ends = Ends::Periodic, .data_level = 4});
  EXPECT_LT((rest.points - fine.points).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Subdivided, points_have_the_same_bits_for_every_number_of_threads_and_level_by_level) {
  const auto p = random_polygon(40001, 1);
  const SubdivisionOptions options{.levels = 7, .ends = Ends::Periodic};  // beyond the size that is streamed
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const auto one = subdivided(four_point_scheme(), p, options);
  omp_set_num_threads(3);
  const auto three = subdivided(four_point_scheme(), p, options);
  omp_set_num_threads(before);
  EXPECT_TRUE(one.points == three.points);
  auto step = p;
  for (int k = 0; k < 7; ++k) step = subdivided(four_point_scheme(), step, {.ends = Ends::Periodic});
  EXPECT_LT((step.points - one.points).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(SubdivisionMatrix, is_two_slanted) {
  const Eigen::MatrixXd S = subdivision_matrix(centred(bspline_scheme(2)), 3, Ends::Zero);
  EXPECT_TRUE(
      S == (Eigen::MatrixXd(7, 3) << .5, 0, 0, 1, 0, 0, .5, .5, 0, 0, 1, 0, 0, .5, .5, 0, 0, 1, 0, 0, .5).finished());
  const Eigen::MatrixXd C = subdivision_matrix(bspline_scheme(4), 5, Ends::Open);
  EXPECT_TRUE(C.row(0) == (Eigen::RowVectorXd(5) << .5, .5, 0, 0, 0).finished());
  EXPECT_TRUE(C.row(1) == (Eigen::RowVectorXd(5) << .125, .75, .125, 0, 0).finished());
}

TEST(SubdivisionMatrix, acts_as_subdivision) {
  for (Ends ends : {Ends::Zero, Ends::Periodic, Ends::Open, Ends::Reflect})
    for (const auto& scheme : {bspline_scheme(5), four_point_scheme(), ternary_four_point_scheme(), tension_scheme(3)})
      for (int n : {7, 8}) {
        const bool is_even = centred(scheme.mask()) == scheme.mask() && scheme.placement() == Placement::Primal;
        if (ends == Ends::Reflect && !is_even) continue;
        const auto p = random_polygon(n, 3);
        const Eigen::MatrixXd expected = subdivision_matrix(scheme, n, ends, 2) * p.points;
        const auto found = subdivided(scheme, p, {.levels = 1, .ends = ends, .data_level = 1});
        ASSERT_EQ(found.points.rows(), expected.rows());
        EXPECT_LT((found.points - expected).cwiseAbs().maxCoeff(), 1e-15);
      }
}

TEST(Subdivided, data_that_cannot_be_are_refused) {
  const auto scheme = bspline_scheme(4);
  EXPECT_THAT([&] { return subdivided(scheme, ControlPolygon{.points = Eigen::MatrixXd(0, 2)}); },
              ThrowsMessage<InvalidInput>(HasSubstr("there must be points, found none")));
  EXPECT_THAT(
      [&] {
        return subdivided(scheme, polygon({1, 2}), {.levels = 4, .ends = Ends::Open});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("must determine points, found none from 2 points after 4 levels")));
  EXPECT_THAT(
      [&] {
        return subdivided(scheme, polygon({1, NAN, 2}));
      },
      ThrowsMessage<InvalidInput>(HasSubstr("finite, found a number that is not at place 1")));
  EXPECT_THROW(subdivided(scheme, polygon({1}), {.levels = -1}), InvalidInput);
  EXPECT_THAT(
      [&] {
        return subdivided(scheme, polygon({1, 2, 3}), {.levels = 60});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("at most 2^31 points")));
  std::vector<double> small(3);
  EXPECT_THROW(subdivide_into(scheme, std::vector<double>{1, 2}, {}, small), InvalidInput);
  EXPECT_THROW(subdivision_matrix(scheme, 0, Ends::Zero), InvalidInput);
  EXPECT_THROW(subdivision_matrix(scheme, 1, Ends::Open), InvalidInput);
}

}  // namespace
}  // namespace batten
