// SPDX-License-Identifier: MIT
#include <batten/bases/difference_scheme.h>
#include <batten/bases/mask_values.h>
#include <batten/domains/errors.h>

#include "../support/known_masks.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace batten {
namespace {

using namespace test;
using Q = Rational;

TEST(DifferenceScheme, of_linear_interpolation_is_the_source_s) {
  // s = (1+x)²/(2x), t = (1+x)/(2x)
  EXPECT_EQ(difference_scheme(parse_mask("1/2,1,1/2", -1), 1), parse_mask("1/2,1/2", -1));
}

TEST(DifferenceScheme, of_the_four_point_scheme_is_the_source_s) {
  const auto s = four_point_mask(Q(1, 16));
  EXPECT_EQ(difference_scheme(s, 1), parse_mask("-1/16,1/16,1/2,1/2,1/16,-1/16", -3));
  EXPECT_EQ(difference_scheme(s, 2), parse_mask("-1/8,1/4,3/4,1/4,-1/8", -3));
  EXPECT_EQ(difference_scheme(s, 3), parse_mask("-1/4,3/4,3/4,-1/4", -3));
}

TEST(DifferenceScheme, commutes_with_differences_as_matrices) {
  // D S = T D entrywise: rows of 2-slanted matrices, S[i,j] = s[i-2j]
  const auto s = four_point_mask(Q(1, 16)), t = difference_scheme(s, 1);
  for (int i = -8; i <= 8; ++i)
    for (int j = -4; j <= 4; ++j)
      EXPECT_EQ(s[i - 2 * j] - s[i - 1 - 2 * j], t[i - 2 * j] - t[i - 2 * (j + 1)]) << i << ", " << j;
}

TEST(DifferenceScheme, is_known_by_its_identity) {
  for (int arity : {2, 3}) {
    const auto s = arity == 2 ? four_point_mask(Q(1, 16)) : ternary_four_point_mask(Q(1, 11));
    for (int order = 1; order <= 3; ++order) {
      const MaskMatrix<Q, 1> t(1, 1, {difference_scheme(s, order, arity)});
      EXPECT_TRUE(is_difference_scheme(t, s, order, 1, arity));
      EXPECT_FALSE(is_difference_scheme(t, s, order + 1, 1, arity));
    }
  }
}

TEST(DifferenceScheme, needs_the_smoothing_factors) {
  EXPECT_THROW(difference_scheme(four_point_mask(Q(1, 10)), 3), InvalidInput);
  EXPECT_THROW(difference_scheme(bspline_mask(3), 0), InvalidInput);
}

TEST(IteratedNorm, of_the_four_point_scheme_has_the_source_s_values) {
  const auto s = four_point_mask(Q(1, 16));
  EXPECT_EQ(iterated_norm(difference_scheme(s, 1), 1), Q(5, 8));
  EXPECT_EQ(iterated_norm(difference_scheme(s, 2), 1), 1);
  EXPECT_EQ(iterated_norm(difference_scheme(s, 2), 2), Q(3, 4));
  EXPECT_EQ(iterated_norm(difference_scheme(s, 2), 3), Q(1, 2));
  for (int n = 1; n <= 12; ++n) EXPECT_EQ(iterated_norm(difference_scheme(s, 3), n), 1) << n;
}

TEST(IteratedNorm, of_the_four_point_scheme_with_tension_follows_the_formulas) {
  // ‖T1‖ = 1/2 + 2|w|, ‖T2‖ = max(1, 8w) for 0 < w < 1/4
  for (const Q& w : {Q(1, 32), Q(1, 16), Q(1, 10), Q(1, 8), Q(3, 20)}) {
    EXPECT_EQ(iterated_norm(difference_scheme(four_point_mask(w), 1), 1), Q(1, 2) + 2 * w);
    EXPECT_EQ(iterated_norm(difference_scheme(four_point_mask(w), 2), 1), w > Q(1, 8) ? 8 * w : Q(1));
  }
  EXPECT_EQ(iterated_norm(difference_scheme(four_point_mask(Q(1, 10)), 2), 2), Q(3, 5));
  EXPECT_EQ(iterated_norm(difference_scheme(four_point_mask(Q(1, 8)), 2), 2), Q(3, 4));
  EXPECT_EQ(iterated_norm(difference_scheme(four_point_mask(Q(3, 20)), 2), 2), Q(24, 25));
}

TEST(IteratedNorm, of_bspline_differences_is_two_to_the_minus_n) {
  for (int m = 2; m <= 5; ++m)
    for (int order = 1; order < m; ++order)
      for (int n = 1; n <= 4; ++n)
        EXPECT_EQ(iterated_norm(difference_scheme(bspline_mask(m), order), n), Q(1, 1 << n)) << m << ' ' << order;
}

TEST(IteratedNorm, of_the_six_point_schemes_has_the_source_s_values) {
  EXPECT_EQ(iterated_norm(difference_scheme(six_point_mask(Q(1, 96)), 3), 2), Q(11, 16));    // 0.6875
  EXPECT_EQ(iterated_norm(difference_scheme(six_point_mask(Q(1, 20)), 2), 2), Q(337, 400));  // 0.8425
  const double printed[] = {1.7, 1.54, 1.88, 1.85, 2.13, 2.23, 2.45, 2.59, 2.86, 3.06};
  const auto t = difference_scheme(six_point_mask(Q(1, 20)), 3);
  for (int n = 1; n <= 10; ++n)
    EXPECT_NEAR(static_cast<double>(iterated_norm(t, n)), printed[n - 1], 0.0051) << n;  // two digits
  const auto a = parse_mask("2,0,-5,0,13,20,13,0,-5,0,2") * Q(1, 20);
  EXPECT_EQ(iterated_norm(difference_scheme(a, 2), 4), Q(122, 125));  // 0.976
  EXPECT_GE(iterated_norm(difference_scheme(a, 2), 3), 1);
}

TEST(IteratedNorm, of_the_ternary_four_point_scheme_has_the_source_s_values) {
  const auto norm = [](const Q& w, int n) {
    return iterated_norm(difference_scheme(ternary_four_point_mask(w), 3, 3), n, 3);
  };
  EXPECT_EQ(norm(Q(1, 11), 1), Q(9, 11));  // 0.81818
  EXPECT_EQ(norm(Q(1, 10), 1), Q(9, 10));
  EXPECT_EQ(norm(Q(2, 25), 1), Q(9, 10));
  EXPECT_EQ(norm(Q(1, 14), 1), Q(27, 28));  // 0.96429
  for (int n = 1; n <= 6; ++n) {
    EXPECT_EQ(norm(Q(1, 15), n), 1);
    EXPECT_EQ(norm(Q(1, 9), n), 1);
  }
}

TEST(IteratedNorm, of_de_rham_trisection_follows_the_formula) {
  // {w, 1-w, 1-w, w}: ‖T‖ = max(2w, |1-2w|); for w = 1/4 the second one is 1/2
  for (const Q& w : {Q(1, 3), Q(1, 4), Q(1, 8)}) {
    const Mask<Q> s(0, {w, 1 - w, 1 - w, w});
    EXPECT_EQ(iterated_norm(difference_scheme(s, 1), 1), std::max(Q(2 * w), Q(1 - 2 * w)));
  }
  EXPECT_EQ(iterated_norm(difference_scheme(bspline_mask(3), 2), 1), Q(1, 2));
}

TEST(IteratedNorm, agrees_with_the_product_of_masks) {
  // long integers against iterated masks summed by cosets
  const auto t = difference_scheme(six_point_mask(Q(1, 20)), 3);
  const auto product = iterated(t, 5);
  Q most = 0;
  for (int r = 0; r < 32; ++r) {
    most = std::max(most, absolute_sum(coset(product, r, 32)));
  }
  EXPECT_EQ(iterated_norm(t, 5), most);
  EXPECT_EQ(iterated_norm(t, 0), 1);
  EXPECT_THROW(iterated_norm(t, -1), InvalidInput);
}

}  // namespace
}  // namespace batten
