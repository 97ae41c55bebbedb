// SPDX-License-Identifier: MIT
#include <batten/bases/inner_products.h>
#include <batten/bases/scaling_pieces.h>
#include <batten/bases/scaling_values.h>
#include <batten/domains/errors.h>

#include "../support/masks_by_hand.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using namespace test;
using Pieces = std::vector<std::vector<Q>>;

/// ∫ f(x) g(x - shift) dx, piece by piece.
Q integral(const ScalingPieces& f, const ScalingPieces& g, int shift) {
  Q sum = 0;
  for (int c = 0; c < static_cast<int>(f.coefficients.size()); ++c) {
    const int d = c + static_cast<int>(f.first - g.first) - shift;
    if (d < 0 || d >= static_cast<int>(g.coefficients.size())) continue;
    const auto &p = f.coefficients[static_cast<std::size_t>(c)], &q = g.coefficients[static_cast<std::size_t>(d)];
    for (std::size_t i = 0; i < p.size(); ++i)
      for (std::size_t j = 0; j < q.size(); ++j) sum += p[i] * q[j] / static_cast<long>(i + j + 1);
  }
  return sum;
}

TEST(ScalingPieces, of_b_splines_are_those_of_the_book) {
  EXPECT_EQ(pieces_if_polynomial(b_spline_by_hand(1))->coefficients, (Pieces{{1}}));
  EXPECT_EQ(pieces_if_polynomial(b_spline_by_hand(2))->coefficients, (Pieces{{0, 1}, {1, -1}}));
  // x^2/2, -3/2 + 3 x - x^2, (3 - x)^2/2 at x = c + u
  EXPECT_EQ(pieces_if_polynomial(b_spline_by_hand(3))->coefficients,
            (Pieces{{0, 0, Q(1, 2)}, {Q(1, 2), 1, -1}, {Q(1, 2), -1, Q(1, 2)}}));
}

TEST(ScalingPieces, do_not_depend_on_the_arity) {
  for (int m : {1, 2, 5, 8}) {
    const auto two = pieces_if_polynomial(b_spline_by_hand(m)), three = pieces_if_polynomial(b_spline_by_hand(m, 3));
    ASSERT_TRUE(two && three);
    EXPECT_EQ(two->coefficients, three->coefficients);
    EXPECT_EQ(two->degree(), m - 1);
  }
}

TEST(ScalingPieces, give_values_of_orders_5_and_6_of_the_reference) {
  EXPECT_EQ(value(*pieces_if_polynomial(b_spline_by_hand(5)), Q(5, 2)), Q(115, 192));
  EXPECT_EQ(value(*pieces_if_polynomial(b_spline_by_hand(6)), 3), Q(11, 20));
  EXPECT_EQ(value(*pieces_if_polynomial(b_spline_by_hand(4)), Q(1, 3)), Q(1, 162));  // x^3/6
  EXPECT_EQ(value(*pieces_if_polynomial(b_spline_by_hand(4)), 4), 0);
  EXPECT_EQ(value(*pieces_if_polynomial(b_spline_by_hand(4)), Q(-1, 3)), 0);
}

TEST(ScalingPieces, agree_with_dyadic_values_and_derivatives) {
  for (int m : {4, 7, 12}) {
    const auto n = b_spline_by_hand(m);
    const auto slope = derivative(*pieces_if_polynomial(n));
    const auto values = values_at_level(n, 3, {1});
    for (int i = 0; i <= 8 * m; ++i) ASSERT_EQ(value(slope, Q(i, 8)), values[i]) << m;
  }
}

TEST(ScalingPieces, integrate_to_the_inner_products_of_the_refinement_equation) {
  for (int m = 1; m <= 12; ++m) {
    const auto n = b_spline_by_hand(m), l = b_spline_by_hand(3);
    const auto f = *pieces_if_polynomial(n), g = *pieces_if_polynomial(l);
    for (int r : {0, 1}) {
      if (r >= m) continue;
      const auto e = inner_products<1>({n, {r}}, {l, {1}});
      for (int i = -3; i <= m; ++i) ASSERT_EQ(e[i], integral(derivative(f, r), derivative(g), i)) << m << " " << i;
    }
  }
}

TEST(ScalingPieces, are_found_for_splines_that_are_not_b_splines) {
  // n = (n^3(x) + n^3(x - 1))/2 has the mask s^3 (1 + x^2)/(1 + x)
  const Scheme scheme("pair", Q(1, 4) * power(Mask<Q>(0, {1, 1}), 2) * Mask<Q>(0, {1, 0, 1}));
  const auto pieces = pieces_if_polynomial(scheme), b = pieces_if_polynomial(b_spline_by_hand(3));
  ASSERT_TRUE(pieces);
  EXPECT_EQ(pieces->degree(), 2);
  for (const Q& x : {Q(1, 3), Q(5, 4), Q(7, 2)}) EXPECT_EQ(value(*pieces, x), (value(*b, x) + value(*b, x - 1)) / 2);
}

TEST(ScalingPieces, of_shifted_masks_start_where_the_support_does) {
  const auto centred_pieces = pieces_if_polynomial({"chaikin", centred(b_spline_by_hand(3).exact_mask())});
  EXPECT_EQ(centred_pieces->first, Q(-3, 2));
  EXPECT_EQ(value(*centred_pieces, 0), Q(3, 4));
}

TEST(ScalingPieces, do_not_exist_for_the_four_point_scheme) {
  EXPECT_FALSE(pieces_if_polynomial(four_point_by_hand()));
  EXPECT_THAT([] { return pieces_if_polynomial(custom_scheme<1>(parse_mask("1/2,3/4,3/4"))); },
              ThrowsMessage<InvalidInput>(HasSubstr("sums to 5/4")));
}

}  // namespace
}  // namespace batten
