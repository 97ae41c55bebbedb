// SPDX-License-Identifier: MIT
#include <batten/bases/mask_text.h>
#include <batten/bases/polyharmonic_coefficients.h>
#include <batten/bases/polyharmonic_residual.h>
#include <batten/bases/quotient_coefficients.h>
#include <batten/bases/torus_zeros.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Q = Rational;

constexpr double pi = std::numbers::pi;

TEST(QuotientCoefficients, of_the_first_example_are_powers_of_the_small_root) {
  // x / (1 - 3x + x²) = Σ -5^(-1/2) ((3 - √5)/2)^|i| x^i [Warren & Weimer 2001, sec. 5.2.1]
  const auto q = quotient_coefficients(parse_mask("1", 1), parse_mask("1,-3,1"), {{-20}, {20}});
  for (int i = -20; i <= 20; ++i)
    EXPECT_NEAR(q[i], -1 / std::sqrt(5) * std::pow((3 - std::sqrt(5)) / 2, std::abs(i)), 1e-15) << i;
}

TEST(QuotientCoefficients, on_the_line_divide_common_zeros_out) {
  const auto q = quotient_coefficients(parse_mask("1,0,0,-1"), parse_mask("2,-2"), {{-4}, {4}});
  for (int i = -4; i <= 4; ++i) EXPECT_NEAR(q[i], i >= 0 && i <= 2 ? 0.5 : 0, 1e-15) << i;
}

TEST(QuotientCoefficients, on_the_line_subtract_half_shifts) {
  // x^(1/2) / (1 + x/2) = Σ (-1/2)^i x^(i + 1/2), and over x^(1/2) the other way
  const auto above = quotient_coefficients(Mask<Q>(0, {1}, 1), parse_mask("1,1/2"), {{-3}, {9}});
  const auto below = quotient_coefficients(parse_mask("1"), Mask<Q>(0, {1, Q(1) / 2}, 1), {{-3}, {9}});
  EXPECT_EQ(above.half(), Index<1>{1});
  EXPECT_EQ(below.half(), Index<1>{1});
  for (int i = -2; i <= 9; ++i) {
    EXPECT_NEAR(above[i], i < 0 ? 0 : std::pow(-0.5, i), 1e-15) << i;
    EXPECT_NEAR(below[i - 1], i < 0 ? 0 : std::pow(-0.5, i), 1e-15) << i;
  }
}

TEST(QuotientCoefficients, on_the_line_say_where_the_denominator_vanishes) {
  EXPECT_THAT(
      [] {
        quotient_coefficients(parse_mask("1"), parse_mask("1,1,1"), {{-1}, {1}});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("vanishes at x = e^(iα), α = 0.666667 π")));
  EXPECT_THAT(
      [] {
        quotient_coefficients(parse_mask("1"), Mask<Q>(), {{-1}, {1}});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("must not be zero")));
}

TEST(QuotientCoefficients, of_a_denominator_without_zeros_are_those_of_its_series) {
  // 1 / (3 + x + y) = Σ (-1)^(i+j) C(i+j, i) 3^-(i+j+1) x^i y^j
  const auto q = quotient_coefficients(parse_mask2("1"), parse_mask2("3,1;1,0"), {{-2, -2}, {6, 6}});
  for (int j = -2; j <= 6; ++j)
    for (int i = -2; i <= 6; ++i) {
      const double binomial =
          i < 0 || j < 0 ? 0 : std::round(std::tgamma(i + j + 1) / std::tgamma(i + 1) / std::tgamma(j + 1));
      EXPECT_NEAR((q[{i, j}]), std::pow(-1, i + j) * binomial * std::pow(3., -(i + j + 1)), 1e-14) << i << ", " << j;
    }
}

TEST(QuotientCoefficients, of_laplacians_are_those_of_the_polyharmonic_masks) {
  // the inner integral in closed form against the trapezoidal rule
  const auto l = five_point_laplacian();
  Q scale = 1;
  for (int m : {1, 2, 3}) {
    const auto q = quotient_coefficients(scale * power(upsampled(l, 2), m), power(l, m), {{-6, -6}, {6, 6}});
    for (int j = -6; j <= 6; ++j)
      for (int i = -6; i <= 6; ++i)
        EXPECT_NEAR((q[{i, j}]), polyharmonic_coefficient(m, i, j), m == 1 ? 1e-14 : 1e-13)
            << m << ": " << i << ", " << j;
    scale /= 4;
  }
}

TEST(QuotientCoefficients, that_are_discontinuous_on_the_torus_satisfy_the_law_of_perfect_flow) {
  // s = 2 d[y] d[y²] / l, an entry of the matrix mask of perfect flows, with a half shift [ibid., sec. 5.3]
  const Mask2<Q> d({0, -1}, {1, 2}, {1, -1}, {0, 1});
  const auto l = five_point_laplacian(), product = Q(2) * (d * upsampled(d, 2));
  const auto s = quotient_coefficients(product, l, {{-4, -4}, {4, 4}});
  EXPECT_EQ(s.half(), (Index<2>{0, 1}));
  const auto left = to_double(l) * s, right = to_double(product);
  for (int j = -3; j <= 3; ++j)
    for (int i = -3; i <= 3; ++i) EXPECT_NEAR((left[{i, j}]), (right[{i, j}]), 1e-13) << i << ", " << j;
}

TEST(QuotientCoefficients, say_where_a_quotient_is_not_bounded) {
  const auto l = five_point_laplacian();
  const IndexBox<2> box{{-1, -1}, {1, 1}};
  EXPECT_THAT([&] { quotient_coefficients(l, l * l, box); },
              ThrowsMessage<InvalidInput>(HasSubstr("(α, β) = (0 π, 0 π), and the numerator less or not at all")));
  EXPECT_THAT([&] { quotient_coefficients(parse_mask2("1"), parse_mask2("1,1;1,0"), box); },
              ThrowsMessage<InvalidInput>(HasSubstr("(α, β) = (0.666667 π, 1.33333 π)")));
  EXPECT_THAT([&] { quotient_coefficients(parse_mask2("1"), parse_mask2("1,-1"), box); },
              ThrowsMessage<InvalidInput>(HasSubstr("isolated zeros")));
  EXPECT_THAT([&] { quotient_coefficients(l, Mask2<Q>(), box); },
              ThrowsMessage<InvalidInput>(HasSubstr("must not be zero")));
}

TEST(DenominatorZeros, finds_single_and_multiple_zeros) {
  const auto zeros_of = [](const Mask2<Q>& b) { return denominator_zeros(TorusQuotient(parse_mask2("1"), b)); };
  EXPECT_TRUE(zeros_of(parse_mask2("3,1;1,0")).empty());
  for (int m : {1, 2, 3}) {
    const auto zeros = zeros_of(power(five_point_laplacian(), m));
    ASSERT_EQ(zeros.size(), 1) << m;
    EXPECT_EQ(zeros[0], (std::array<double, 2>{0, 0}));
  }
  // 1 + x + y/2 = 0: |1 + x| = 1/2
  const auto zeros = zeros_of(parse_mask2("1,1;1/2,0"));
  ASSERT_EQ(zeros.size(), 2);
  for (const auto& [alpha, beta] : zeros)
    EXPECT_NEAR(std::abs(std::remainder(alpha, 2 * pi)), std::acos(-7. / 8), 1e-8);
}

}  // namespace
}  // namespace batten
