// SPDX-License-Identifier: MIT
#include <batten/bases/mask.h>
#include <batten/bases/mask_division.h>
#include <batten/bases/mask_text.h>
#include <batten/bases/mask_values.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Q = Rational;
using M = Mask<Rational>;
using M2 = Mask2<Rational>;

const M one_plus_x(0, {1, 1});
const M four_point = parse_mask("-1/16,0,9/16,1,9/16,0,-1/16", -3);

TEST(Mask, keeps_the_smallest_box_that_holds_its_coefficients) {
  const M s(-2, {0, 0, 5, 0, 7, 0});
  EXPECT_EQ(s.first(), Index<1>{0});
  EXPECT_EQ(s.last(), Index<1>{2});
  EXPECT_EQ(s[0], 5);
  EXPECT_EQ(s[2], 7);
  EXPECT_EQ(s[-2], 0);
  EXPECT_EQ(s[100], 0);
  const M2 t({3, 4}, {3, 3}, {0, 0, 0, 0, 0, 2, 0, 0, 0});
  EXPECT_EQ(t, M2::monomial({5, 5}, 2));
}

TEST(Mask, of_zeros_is_zero) {
  EXPECT_EQ(M(7, {0, 0}), M());
  EXPECT_TRUE((one_plus_x - one_plus_x).is_zero());
  EXPECT_EQ(M2({1, 1}, {2, 2}, {0, 0, 0, 0}).last(), (Index<2>{-1, -1}));
  EXPECT_EQ(one_plus_x + M(), one_plus_x);
  EXPECT_TRUE((one_plus_x * M()).is_zero());
}

TEST(Mask, multiplies_and_adds_like_polynomials) {
  EXPECT_EQ(one_plus_x * one_plus_x, M(0, {1, 2, 1}));
  EXPECT_EQ(power(one_plus_x, 5), M(0, {1, 5, 10, 10, 5, 1}));
  EXPECT_EQ(power(one_plus_x, 0), M::constant(1));
  EXPECT_EQ(M(-1, {1, 1}) - M(0, {1, 1}), M(-1, {1, 0, -1}));
  EXPECT_EQ(-one_plus_x, Q(-1) * one_plus_x);
  const M2 x = M2::monomial({1, 0}), y = M2::monomial({0, 1}), one = M2::constant(1);
  EXPECT_EQ((one + x) * (one + y) * (one + x * y), M2({0, 0}, {3, 3}, {1, 1, 0, 1, 2, 1, 0, 1, 1}));
}

TEST(Mask, of_half_powers_carries_the_shift) {
  const M d(-1, {1, -1}, 1);  // x^(-1/2) - x^(1/2)
  EXPECT_EQ(d * d, M(-1, {1, -2, 1}));
  EXPECT_EQ(upsampled(d, 2), M(-1, {1, 0, -1}));
  EXPECT_EQ(upsampled(d, 3), M(-2, {1, 0, 0, -1}, 1));
  EXPECT_EQ(reflected(d), -d);
  EXPECT_EQ(M(-1, {1, -2, 1}), exact_quotient(d * d * d, d));
  EXPECT_EQ(exact_quotient(d * d, d), d);
  EXPECT_EQ(exact_quotient(M(-1, {1, 0, -1}), d), M(-1, {1, 1}, 1));
  const M2 dx({-1, 0}, {2, 1}, {1, -1}, {1, 0}), dy({0, -1}, {1, 2}, {1, -1}, {0, 1});
  EXPECT_EQ(dx * dy, M2({-1, -1}, {2, 2}, {1, -1, -1, 1}, {1, 1}));
  EXPECT_EQ(swapped(dx), dy);
  EXPECT_EQ(dx * dx + dy * dy, M2({-1, -1}, {3, 3}, {0, 1, 0, 1, -4, 1, 0, 1, 0}));
  EXPECT_THAT([&] { return dx + dy; },
              ThrowsMessage<InvalidInput>(HasSubstr("the same half, found (1/2, 0) and (0, 1/2)")));
}

TEST(Mask, is_upsampled_reflected_shifted_and_swapped) {
  EXPECT_EQ(upsampled(four_point, 2)[6], Q(-1, 16));
  EXPECT_EQ(upsampled(M(-1, {1, 2}), 3), M(-3, {1, 0, 0, 2}));
  EXPECT_EQ(reflected(M(-1, {1, 2, 3, 4})), M(-2, {4, 3, 2, 1}));
  EXPECT_EQ(reflected(four_point), four_point);
  EXPECT_EQ(shifted(one_plus_x, {-4}), M(-4, {1, 1}));
  const M2 t({0, 1}, {2, 3}, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(swapped(t), M2({1, 0}, {3, 2}, {1, 3, 5, 2, 4, 6}));
  EXPECT_EQ(swapped(swapped(t)), t);
  EXPECT_EQ(reflected(t), M2({-1, -3}, {2, 3}, {6, 5, 4, 3, 2, 1}));
  EXPECT_EQ(upsampled(t, 2)[(Index<2>{2, 6})], 6);
  EXPECT_EQ(tensor_product(one_plus_x, M(2, {3, 5})), M2({0, 2}, {2, 2}, {3, 3, 5, 5}));
}

TEST(Mask, is_centred_with_a_half_shift_when_its_length_is_even) {
  EXPECT_EQ(centred(M(0, {1, 2, 1})), M(-1, {1, 2, 1}));
  EXPECT_EQ(centred(M(5, {1, 3, 3, 1})), M(-2, {1, 3, 3, 1}, 1));
  EXPECT_EQ(centred(M2({0, 0}, {2, 1}, {1, 1})), M2({-1, 0}, {2, 1}, {1, 1}, {1, 0}));
}

TEST(Mask, has_one_coset_for_each_residue) {
  EXPECT_EQ(coset(four_point, 0), M::constant(1));
  EXPECT_EQ(coset(four_point, 1), parse_mask("-1/16,9/16,9/16,-1/16", -2));
  const M ternary(-2, {1, 2, 3, 2, 1});
  M sum;
  for (int r : {0, 1, 2}) sum += shifted(upsampled(coset(ternary, r, 3), 3), {r});
  EXPECT_EQ(sum, ternary);
  const M2 t({-1, -1}, {3, 3}, {1, 2, 3, 4, 5, 6, 7, 8, 9});
  EXPECT_EQ(coset(t, {0, 0}), M2::constant(5));
  EXPECT_EQ(coset(t, {1, 1}), M2({-1, -1}, {2, 2}, {1, 3, 7, 9}));
  EXPECT_EQ(coset(t, {-1, 0}), M2({0, 0}, {2, 1}, {4, 6}));
}

TEST(Mask, is_divided_exactly_or_the_remainder_is_named) {
  // [Warren & Weimer 2001, sec. 3.2.4]: the four-point mask is -(1/16) x^-3 (1+x)^4 (1-4x+x^2)
  EXPECT_EQ(exact_quotient(four_point, power(one_plus_x, 4)), Q(-1, 16) * M(-3, {1, -4, 1}));
  EXPECT_EQ(multiplicity(one_plus_x, four_point), 4);
  EXPECT_FALSE(divides(power(one_plus_x, 5), four_point));
  EXPECT_THAT(
      [] {
        return exact_quotient(M(0, {1, 1, 1}), one_plus_x);
      },
      ThrowsMessage<InvalidInput>(HasSubstr("exact_quotient: 1 + x must divide 1 + x + x^2, found the remainder x^2")));
  EXPECT_THROW(exact_quotient(one_plus_x, M()), InvalidInput);
  EXPECT_TRUE(exact_quotient(M(), one_plus_x).is_zero());
  EXPECT_THROW(multiplicity(one_plus_x, M()), InvalidInput);
}

TEST(Mask, of_two_variables_is_divided_exactly) {
  const M2 one = M2::constant(1), x = M2::monomial({1, 0}), y = M2::monomial({0, 1});
  const M2 a = (one + x) * (one + y) * (one + x * y), b = one + M2::monomial({-1, 1});
  EXPECT_EQ(exact_quotient(a * b, b), a);
  EXPECT_EQ(exact_quotient(a * b, a), b);
  EXPECT_FALSE(divides(b, a));
  EXPECT_EQ(multiplicity(one + x, a * a), 2);
  // numerator of the two-scale law of the Laplacian: l[x^2, y^2] is not divisible by l[x, y]
  const M2 l({-1, -1}, {3, 3}, {0, 1, 0, 1, -4, 1, 0, 1, 0});
  EXPECT_FALSE(divides(l, upsampled(l, 2)));
}

TEST(Mask, of_doubles_is_divided_to_rounding) {
  const Mask<double> factor(0, {1, -4, 1}), b(0, {1, 1});
  const Mask<double> product = factor * power(b, 12);
  const auto quotient = exact_quotient(product, power(b, 8));
  const auto expected = factor * power(b, 4);
  for (int i = 0; i <= 6; ++i) EXPECT_NEAR(quotient[i], expected[i], 1e-10);
  EXPECT_FALSE(divides(Mask<double>(0, {1, 1}), Mask<double>(0, {1, 1, 1})));
  EXPECT_TRUE(divides(Mask<double>(0, {0.1, -30}), Mask<double>(0, {0.1, -30}) * power(b, 40)));
}

TEST(Mask, has_values_and_derivatives_at_points) {
  EXPECT_EQ(evaluate(four_point, Q(1)), 2);
  EXPECT_EQ(evaluate(four_point, Q(-1)), 0);
  for (int r = 0; r < 4; ++r) EXPECT_EQ(evaluate(derivative(four_point, r), Q(-1)), 0) << r;
  EXPECT_NE(evaluate(derivative(four_point, 4), Q(-1)), 0);
  EXPECT_EQ(derivative(M(-2, {1, 0, 0, 1})), M(-3, {-2, 0, 0, 1}));
  EXPECT_EQ(derivative(M(0, {1}, 1)), M(-1, {Q(1, 2)}, 1));
  EXPECT_DOUBLE_EQ(evaluate(Mask<double>(-1, {1, -1}, 1), 4), 0.5 - 2);
  EXPECT_THROW(evaluate(Mask<double>(-1, {1, -1}, 1), -4), InvalidInput);
  EXPECT_THROW(evaluate(M(0, {1}, 1), Q(4)), InvalidInput);
  EXPECT_THROW(evaluate(four_point, Q(0)), InvalidInput);
  EXPECT_EQ(evaluate(M(2, {5}), Q(0)), 0);
  const M2 t({-1, 0}, {2, 2}, {1, 2, 3, 4});  // 1/x + 2 + 3 y/x + 4 y
  EXPECT_EQ(evaluate(t, {Q(2), Q(3)}), Q(1, 2) + 2 + Q(9, 2) + 12);
  EXPECT_EQ(evaluate(derivative(t, {1, 1}), {Q(2), Q(3)}), Q(-3, 4));
  EXPECT_EQ(sum(t), 10);
  EXPECT_EQ(absolute_sum(four_point), Q(9, 4));
}

TEST(Mask, on_the_unit_circle_is_its_fourier_series) {
  // (1+x)^2/(2x) at e^(-iω) is 1 + cos ω
  const Mask<double> hat(-1, {0.5, 1, 0.5});
  const auto value = evaluate(hat, std::polar(1., -std::numbers::pi / 3));
  EXPECT_NEAR(value.real(), 1.5, 1e-15);
  EXPECT_NEAR(value.imag(), 0, 1e-15);
}

TEST(Mask, refuses_what_does_not_fit) {
  EXPECT_THAT(
      [] {
        return M2({0, 0}, {2, 2}, {1, 2, 3});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("needs 4 coefficients, found 3")));
  EXPECT_THAT(
      [] {
        return Mask<double>(0, {1, std::numeric_limits<double>::quiet_NaN()});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("finite, found a number that is not at place 1")));
  EXPECT_THROW(M(0, {1}, 2), InvalidInput);
  EXPECT_THROW(upsampled(four_point, 0), InvalidInput);
  EXPECT_THROW(power(four_point, -1), InvalidInput);
  EXPECT_THROW(coset(four_point, 0, 0), InvalidInput);
  EXPECT_THROW(derivative(four_point, -1), InvalidInput);
}

TEST(Mask, of_many_rounds_is_the_product_of_the_upsampled_masks) {
  EXPECT_EQ(iterated(M(0, {1, 1}), 3), M(0, {1, 1, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(iterated(M(0, {1, 1, 1}), 2, 3), M(0, std::vector<Q>(9, 1)));
  EXPECT_EQ(iterated(four_point, 0), M::constant(1));
}

}  // namespace
}  // namespace batten
