// SPDX-License-Identifier: MIT
#include <batten/bases/exact_linear.h>
#include <batten/bases/least_absolute_sum.h>
#include <batten/bases/local_spectrum.h>
#include <batten/domains/errors.h>

#include "../support/known_masks.h"
#include <gtest/gtest.h>

namespace batten {
namespace {

using namespace test;
using Q = Rational;

RationalMatrix matrix(int rows, int columns, const std::vector<Q>& entries) {
  RationalMatrix a(rows, columns);
  for (int k = 0; k < rows * columns; ++k) a(k / columns, k % columns) = entries[static_cast<std::size_t>(k)];
  return a;
}

TEST(CharacteristicPolynomial, of_a_companion_matrix_is_its_polynomial) {
  // λ³ - 6λ² + 11λ - 6
  EXPECT_EQ(characteristic_polynomial(matrix(3, 3, {0, 0, 6, 1, 0, -11, 0, 1, 6})), (std::vector<Q>{-6, 11, -6, 1}));
  EXPECT_EQ(characteristic_polynomial(matrix(3, 3, {0, 1, 0, 0, 0, 1, 6, -11, 6})), (std::vector<Q>{-6, 11, -6, 1}));
}

TEST(CharacteristicPolynomial, vanishes_at_its_matrix) {
  // the theorem of Cayley and Hamilton
  const auto a = matrix(4, 4, {1, 2, 0, -1, 3, 0, 5, 1, Q(1, 2), 4, -2, 0, 7, 1, 1, 3});
  const auto p = characteristic_polynomial(a);
  RationalMatrix value(4, 4);
  for (std::size_t k = p.size(); k-- > 0;) {
    value = value * a;
    for (int i = 0; i < 4; ++i) value(i, i) += p[k];
  }
  EXPECT_EQ(value, RationalMatrix(4, 4));
}

TEST(RootTest, tells_roots_on_the_circle_from_those_inside) {
  const std::vector<Q> p = {Q(1, 4), 0, 1};  // ±i/2
  EXPECT_TRUE(has_root_not_inside(p, Q(1, 2)));
  EXPECT_FALSE(has_root_not_inside(p, Q(1, 2) + Q(1, 1000000)));
  EXPECT_TRUE(has_root_not_inside({2, -3, 1}, 2));  // 1 and 2
  EXPECT_FALSE(has_root_not_inside({2, -3, 1}, 3));
  EXPECT_TRUE(has_root_not_inside({1, -2, 1}, 1));  // twice 1
  EXPECT_FALSE(has_root_not_inside({0, 0, 1}, Q(1, 100)));
  EXPECT_FALSE(has_root_not_inside({5}, 1));
  EXPECT_THROW(has_root_not_inside({0}, 1), InvalidInput);
}

TEST(RootTest, divides_roots_out_no_more_often_than_asked) {
  EXPECT_EQ(without_root({1, -2, 1}, 1, 1), (std::vector<Q>{-1, 1}));
  EXPECT_EQ(without_root({1, -2, 1}, 1, 5), (std::vector<Q>{1}));
  EXPECT_EQ(without_root({1, -2, 1}, 2, 5), (std::vector<Q>{1, -2, 1}));
}

TEST(NullSpace, is_what_the_matrix_sends_to_zero) {
  const auto a = matrix(2, 4, {1, 2, 3, 4, 2, 4, 6, 9});
  const auto basis = null_space(a);
  ASSERT_EQ(basis.size(), 2u);
  for (const auto& v : basis) EXPECT_EQ(a * v, std::vector<Q>(2));
}

TEST(LeastAbsoluteSum, finds_the_cheapest_of_many_solutions) {
  Eigen::MatrixXd a(2, 4);
  a << 1, 0, 1, 3, 0, 1, 1, 4;
  const Eigen::Vector2d b(-3, -4);
  const auto found = least_absolute_sum(a, b, Eigen::Vector4d::Ones());
  EXPECT_NEAR(found.cost, 1, 1e-12);                                                   // -1 times the last column
  EXPECT_NEAR(least_absolute_sum(a, b, Eigen::Vector4d(1, 1, 1, 10)).cost, 4, 1e-12);  // -3 of the third, -1 of (0, 1)
}

TEST(GridValues, of_bsplines_and_box_splines_are_the_source_s) {
  const auto cubic = grid_values(bspline_mask(4));
  ASSERT_TRUE(cubic);
  EXPECT_EQ(*cubic, parse_mask("1/6,2/3,1/6", 1));
  const auto quartic = grid_values(three_direction_quartic_mask());
  ASSERT_TRUE(quartic);
  EXPECT_EQ((*quartic)[(Index<2>{2, 2})], Q(1, 2));
  EXPECT_EQ((*quartic)[(Index<2>{1, 1})], Q(1, 12));
  EXPECT_EQ(grid_values(bspline_mask(1)), std::nullopt);  // not continuous
}

TEST(LocalSpectrum, of_the_four_point_scheme_has_a_quarter_twice) {
  auto p = local_characteristic_polynomial(four_point_mask(Q(1, 16)), 2, FixedPoint<1>{}, LocalData::Limits);
  p = without_root(std::move(p), Q(1, 4), 1);
  EXPECT_EQ(without_root(p, Q(1, 4), 1).size() + 1, p.size());
}

TEST(LocalSpectrum, of_a_cubic_bspline_has_powers_of_two_and_an_eighth_twice) {
  const auto p = local_characteristic_polynomial(bspline_mask(4), 2, FixedPoint<1>{}, LocalData::Limits);
  ASSERT_EQ(p.size(), 6u);
  std::vector<Q> rest = p;
  for (const Q& root : {Q(1), Q(1, 2), Q(1, 4), Q(1, 8), Q(1, 8)}) rest = without_root(std::move(rest), root, 1);
  EXPECT_EQ(rest, (std::vector<Q>{1}));
}

}  // namespace
}  // namespace batten
