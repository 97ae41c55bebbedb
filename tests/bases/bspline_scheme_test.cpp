// SPDX-License-Identifier: MIT
#include <batten/bases/bspline_scheme.h>
#include <batten/bases/mask_text.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Q = Rational;
using M = Mask<Rational>;

TEST(BSplineScheme, has_the_printed_masks) {
  // [Warren & Weimer 2001, eq. 2.7]
  EXPECT_EQ(bspline_mask(1), parse_mask("1,1"));
  EXPECT_EQ(bspline_mask(2), parse_mask("1/2,1,1/2"));
  EXPECT_EQ(bspline_mask(3), parse_mask("1/4,3/4,3/4,1/4"));
  EXPECT_EQ(bspline_mask(4), parse_mask("1/8,1/2,3/4,1/2,1/8"));
  EXPECT_EQ(bspline_mask(5), parse_mask("1/16,5/16,10/16,10/16,5/16,1/16"));
  EXPECT_EQ(coset(bspline_mask(4), 0), parse_mask("1/8,3/4,1/8"));
  EXPECT_EQ(coset(bspline_mask(4), 1), parse_mask("1/2,1/2"));
  for (int m = 2; m <= 64; ++m) EXPECT_EQ(bspline_mask(m), Q(1, 2) * M(0, {1, 1}) * bspline_mask(m - 1));
}

TEST(BSplineScheme, of_arity_three_refines_by_thirds) {
  EXPECT_EQ(bspline_mask(2, 3), parse_mask("1/3,2/3,1,2/3,1/3"));
  const auto scheme = bspline_scheme(4, 3);
  EXPECT_EQ(scheme.support().upper[0], 4);
  for (const Q& x : {Q(1, 7), Q(5, 3), Q(29, 8)}) {
    Q sum = 0;
    for (int i = 0; i <= 8; ++i) sum += scheme.exact_mask()[i] * bspline_value(4, 3 * x - i);
    EXPECT_EQ(sum, bspline_value(4, x));
  }
}

TEST(BSplineScheme, is_centred_without_drift) {
  EXPECT_EQ(centred(bspline_scheme(4)).exact_mask(), parse_mask("1/8,1/2,3/4,1/2,1/8", -2));
  const auto chaikin = centred(bspline_scheme(3));
  EXPECT_EQ(chaikin.support().lower[0], Q(-3, 2));
  EXPECT_EQ(chaikin.support().upper[0], Q(3, 2));
  EXPECT_EQ(bspline_scheme(3).placement(), Placement::Dual);
  EXPECT_EQ(bspline_scheme(4).placement(), Placement::Primal);
}

TEST(BSplineScheme, subdivides_the_example_of_the_book) {
  // [Warren & Weimer 2001, sec. 2.1.3]
  const M p(0, {1, 3, 2, 5, 6});
  const M linear = bspline_mask(2) * upsampled(p, 2);
  EXPECT_EQ(linear, parse_mask("1/2,1,2,3,5/2,2,7/2,5,11/2,6,3"));
  EXPECT_EQ(bspline_mask(2) * upsampled(linear, 2),
            parse_mask("1/4,1/2,3/4,1,3/2,2,5/2,3,11/4,5/2,9/4,2,11/4,7/2,17/4,5,21/4,11/2,23/4,6,9/2,3,3/2"));
  EXPECT_EQ(bspline_mask(4) * upsampled(p, 2), parse_mask("1/8,1/2,9/8,2,21/8,5/2,5/2,7/2,19/4,11/2,41/8,3,3/4"));
}

TEST(BSplineScheme, by_repeated_averaging_is_the_same_scheme) {
  const M p(-3, {1, 3, Q(2, 7), 5, 6});
  for (int m = 1; m <= 12; ++m) EXPECT_EQ(lane_riesenfeld(p, m), bspline_mask(m) * upsampled(p, 2));
}

TEST(BSplineValue, at_integers_and_half_integers_is_exact) {
  const std::vector<std::vector<Q>> at_integers = {{0, 1, 0},
                                                   {0, Q(1, 2), Q(1, 2), 0},
                                                   {0, Q(1, 6), Q(2, 3), Q(1, 6), 0},
                                                   {0, Q(1, 24), Q(11, 24), Q(11, 24), Q(1, 24), 0},
                                                   {0, Q(1, 120), Q(13, 60), Q(11, 20), Q(13, 60), Q(1, 120), 0}};
  const std::vector<std::vector<Q>> between = {
      {Q(1, 2), Q(1, 2)},
      {Q(1, 8), Q(3, 4), Q(1, 8)},
      {Q(1, 48), Q(23, 48), Q(23, 48), Q(1, 48)},
      {Q(1, 384), Q(19, 96), Q(115, 192), Q(19, 96), Q(1, 384)},
      {Q(1, 3840), Q(79, 1280), Q(841, 1920), Q(841, 1920), Q(79, 1280), Q(1, 3840)}};
  for (int m = 2; m <= 6; ++m) {
    const auto& whole = at_integers[static_cast<std::size_t>(m) - 2];
    const auto& half = between[static_cast<std::size_t>(m) - 2];
    for (int k = 0; k <= m; ++k) EXPECT_EQ(bspline_value(m, Q(k)), whole[static_cast<std::size_t>(k)]) << m << k;
    for (int k = 0; k < m; ++k) EXPECT_EQ(bspline_value(m, Q(2 * k + 1, 2)), half[static_cast<std::size_t>(k)]) << m;
  }
}

TEST(BSplineValue, of_order_four_has_the_printed_pieces) {
  // [Warren & Weimer 2001, sec. 1.1.1]
  for (int i = 0; i < 8; ++i) {
    const Q t(i, 8), a = t, b = 1 + t, c = 2 + t, d = 3 + t;
    EXPECT_EQ(bspline_value(4, a), a * a * a / 6);
    EXPECT_EQ(bspline_value(4, b), Q(2, 3) - 2 * b + 2 * b * b - b * b * b / 2);
    EXPECT_EQ(bspline_value(4, c), -Q(22, 3) + 10 * c - 4 * c * c + c * c * c / 2);
    EXPECT_EQ(bspline_value(4, d), Q(32, 3) - 8 * d + 2 * d * d - d * d * d / 6);
  }
}

TEST(BSplineValue, of_a_curve_at_integers_is_that_of_the_book) {
  // the cubic spline with coefficients 1, 3, 2, 5, 6 [Warren & Weimer 2001, sec. 2.1.1]
  const std::vector<Q> p = {1, 3, 2, 5, 6};
  const std::vector<Q> expected = {0, Q(1, 6), Q(7, 6), Q(5, 2), Q(8, 3), Q(14, 3), Q(29, 6), 1, 0};
  for (int x = 0; x <= 8; ++x) {
    Q sum = 0;
    for (int i = 0; i < 5; ++i) sum += p[static_cast<std::size_t>(i)] * bspline_value(4, Q(x - i));
    EXPECT_EQ(sum, expected[static_cast<std::size_t>(x)]);
  }
}

TEST(BSplineValue, obeys_refinement_and_partition_of_unity_exactly) {
  std::mt19937 random(1);
  for (int m = 1; m <= 12; ++m)
    for (int trial = 0; trial < 5; ++trial) {
      const Q x(static_cast<int>(random() % 10000u), 701);
      Q sum = 0, all = 0;
      for (int i = 0; i <= m; ++i) sum += bspline_mask(m)[i] * bspline_value(m, 2 * x - i);
      for (int i = -m; i <= 16; ++i) all += bspline_value(m, x - i);
      EXPECT_EQ(sum, bspline_value(m, x));
      EXPECT_EQ(all, 1);
    }
}

TEST(BSplineValue, has_the_differences_of_the_lower_order_as_derivative) {
  for (int m = 2; m <= 9; ++m)
    for (int r = 1; r < m; ++r)
      for (const Q& x : {Q(1, 3), Q(1), Q(7, 5), Q(m) - Q(1, 9)})
        EXPECT_EQ(bspline_value(m, x, r), bspline_value(m - 1, x, r - 1) - bspline_value(m - 1, x - 1, r - 1));
  EXPECT_EQ(bspline_value(1, Q(0)), 1);
  EXPECT_EQ(bspline_value(1, Q(1)), 0);
}

TEST(BSplineValue, in_doubles_does_not_cancel_at_order_forty) {
  EXPECT_EQ(bspline_value(40, 40.5), 0);
  EXPECT_NEAR(bspline_value(40, 3.5) / bspline_value(40, 36.5), 1, 1e-15);
  EXPECT_GT(bspline_value(40, 39.99), 0);
  EXPECT_DOUBLE_EQ(bspline_value(5, 2.5), 115. / 192);
  EXPECT_DOUBLE_EQ(bspline_value(6, 3.), 11. / 20);
}

TEST(BSplineValue, is_a_combination_of_truncated_powers) {
  EXPECT_EQ(truncated_power(1, Q(0)), 1);
  EXPECT_EQ(truncated_power(1, Q(-1, 9)), 0);
  EXPECT_EQ(truncated_power(4, Q(2)), Q(8, 6));
  EXPECT_EQ(bspline_difference_mask(2), M(0, {1, -2, 1}));
  const Q x(13, 7);
  EXPECT_EQ(truncated_power(2, x) - 2 * truncated_power(2, x - 1) + truncated_power(2, x - 2), bspline_value(2, x));
}

TEST(BSplineScheme, obeys_the_two_scale_law_of_differences) {
  // d_k[x] s[x] = 2 d_{k-1}[x^2], d_k = (2^k (1 - x))^m [Warren & Weimer 2001, sec. 4.2], here k = 1
  for (int m = 1; m <= 8; ++m) {
    const auto d = bspline_difference_mask(m);
    EXPECT_EQ(Rational(1 << m) * d * bspline_mask(m), Rational(2) * upsampled(d, 2));
  }
}

TEST(BSplineScheme, refuses_orders_and_derivatives_that_do_not_exist) {
  EXPECT_THAT([] { return bspline_scheme(0); }, ThrowsMessage<InvalidInput>(HasSubstr("1 to 64, found 0")));
  EXPECT_THROW(bspline_mask(65), InvalidInput);
  EXPECT_THROW(bspline_mask(3, 5), InvalidInput);
  EXPECT_THAT([] { return bspline_value(3, Q(1), 3); },
              ThrowsMessage<InvalidInput>(HasSubstr("order 3 has derivatives 0 to 2, found 3")));
  EXPECT_THROW(bspline_value(3, 1., -1), InvalidInput);
}

}  // namespace
}  // namespace batten
