// SPDX-License-Identifier: MIT
#include <batten/bases/difference_scheme.h>
#include <batten/bases/mask_text.h>
#include <batten/bases/mask_values.h>
#include <batten/bases/optimal_mask.h>
#include <batten/bases/polyharmonic_scheme.h>
#include <batten/bases/smoothness.h>
#include <batten/bases/sum_rules.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ctime>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Q = Rational;

double optimum_of(int order, int size, const MaskConstraints& constraints = {}) {
  return optimal_mask(order, size, constraints).residual.convert_to<double>();
}

MaskConstraints precision(int degree) { return {.precision = degree}; }

/// The numbers of variational.md, section 5.2, and of the issue, to all their digits.
void expect_equal_digits(double found, double printed, double unit) { EXPECT_NEAR(found, printed, 0.51 * unit); }

TEST(OptimalMask, of_order_one_has_the_known_optima) {
  EXPECT_EQ(optimal_mask(1, 3).residual, Q(8) / 5);
  EXPECT_EQ(optimal_mask(1, 5).residual, Q(8) / 33);
  expect_equal_digits(optimum_of(1, 9), 0.0235863586, 1e-10);
  expect_equal_digits(optimum_of(1, 17), 0.0020372568, 1e-10);
  expect_equal_digits(optimum_of(1, 21), 0.0008851189, 1e-10);
}

TEST(OptimalMask, of_order_one_with_constant_precision_has_the_known_optima) {
  EXPECT_EQ(optimal_mask(1, 3, precision(0)).residual, 4);
  EXPECT_EQ(optimal_mask(1, 5, precision(0)).residual, Q(4) / 9);
  expect_equal_digits(optimum_of(1, 9, precision(0)), 0.0312019, 1e-7);
  expect_equal_digits(optimum_of(1, 17, precision(0)), 0.00249017, 1e-8);
  expect_equal_digits(optimum_of(1, 21, precision(0)), 0.00106281, 1e-8);
}

TEST(OptimalMask, of_order_two_has_the_known_optima) {
  expect_equal_digits(optimum_of(2, 5), 1.66052, 1e-5);
  expect_equal_digits(optimum_of(2, 9), 0.158070, 1e-6);
  expect_equal_digits(optimum_of(2, 17), 0.00425626, 1e-8);
}

TEST(TruncatedLaurentMask, keeps_constants_once_its_cosets_are_divided_by_their_sums) {
  const auto raw = truncated_laurent_mask(1, 9);
  const auto mask = with_unit_cosets(raw);
  for (const Index<2>& r : {Index<2>{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
    EXPECT_EQ(sum(coset(mask, r)), 1);
    EXPECT_GT(std::abs(sum(coset(raw, r)) - 1), 1e-4);
  }
  EXPECT_EQ(sum_rule_order(mask), 2);  // symmetry gives one order more
  EXPECT_NEAR((to_double(mask)[{1, 0}] / to_double(mask)[{3, 2}]), (raw[{1, 0}] / raw[{3, 2}]), 1e-12);
  EXPECT_THROW(with_unit_cosets(Mask2<double>::constant(1)), InvalidInput);
}

TEST(OptimalMask, of_order_two_with_zeros_of_order_four_has_the_known_optima) {
  expect_equal_digits(optimum_of(2, 9, precision(3)), 0.436029, 1e-6);
  expect_equal_digits(optimum_of(2, 17, precision(3)), 0.00474329, 1e-8);
}

TEST(OptimalMask, of_size_five_is_a_thirty_third_of_integers) {
  const auto mask = optimal_mask(1, 5).mask;
  EXPECT_EQ(Q(33) * mask, parse_mask2("0,1,-4,1,0; 1,8,15,8,1; -4,15,48,15,-4; 1,8,15,8,1; 0,1,-4,1,0", {-2, -2}));
  // not affine invariant
  EXPECT_EQ(sum(coset(mask, {0, 0})), Q(32) / 33);
  EXPECT_EQ(sum(coset(mask, {1, 0})), Q(34) / 33);
}

TEST(OptimalMask, of_size_nine_is_the_printed_one) {
  // [Warren & Weimer 2001, sec. 5.2.3], four digits
  const auto s = to_double(optimal_mask(1, 9).mask);
  const auto expect_printed = [&](int i, int j, double printed) { EXPECT_NEAR((s[{i, j}]), printed, 6e-5) << i << j; };
  expect_printed(0, 0, 1.4539);
  expect_printed(1, 0, 0.4539);
  expect_printed(2, 0, -0.1273);
  expect_printed(3, 0, -0.0331);
  expect_printed(1, 1, 0.2445);
  expect_printed(2, 2, 0.0211);
  expect_printed(3, 3, 0.0042);
  expect_printed(4, 4, 0);
}

TEST(OptimalMask, residual_is_that_of_the_mask) {
  for (int size : {3, 5, 9, 17}) {
    const auto found = optimal_mask(2, size, precision(0));
    EXPECT_EQ(residual_norm(found.mask, 2), found.residual);
  }
}

TEST(OptimalMask, precision_gives_zeros_of_its_order) {
  for (int degree : {0, 1, 2, 3}) {
    const auto mask = optimal_mask(2, 9, precision(degree)).mask;
    EXPECT_EQ(sum(mask), 4);
    EXPECT_GE(sum_rule_order(mask), degree + 1);
  }
}

TEST(OptimalMask, without_symmetry_has_the_same_optimum) {
  // the mean of an optimum and its images is one too
  for (auto symmetry : {MaskSymmetry::Rectangle, MaskSymmetry::Point, MaskSymmetry::None})
    EXPECT_EQ(optimal_mask(1, 5, {.symmetry = symmetry}).residual, Q(8) / 33);
  EXPECT_EQ(optimal_mask(1, 5, {.precision = 0, .symmetry = MaskSymmetry::None}).residual, Q(4) / 9);
}

TEST(OptimalMask, vanishes_outside_its_shape) {
  const auto disc = optimal_mask(1, 9, {.shape = MaskShape::Disc});
  const auto diamond = optimal_mask(1, 9, {.shape = MaskShape::Diamond});
  for (int j = -4; j <= 4; ++j)
    for (int i = -4; i <= 4; ++i) {
      const bool in_disc = i * i + j * j <= 16, in_diamond = std::abs(i) + std::abs(j) <= 4;
      EXPECT_TRUE(in_disc || disc.mask[(Index<2>{i, j})] == 0) << i << ", " << j;
      EXPECT_TRUE(in_diamond || diamond.mask[(Index<2>{i, j})] == 0) << i << ", " << j;
    }
  EXPECT_LE(optimal_mask(1, 9).residual, disc.residual);
  EXPECT_LE(disc.residual, diamond.residual);
}

TEST(OptimalMask, has_the_prescribed_zeros) {
  const auto mask = optimal_mask(1, 7, {.zeros = {{{-1, -1}, 2}}}).mask;
  const auto s = to_double(mask);
  EXPECT_NEAR((evaluate<double, 2>(s, {-1, -1})), 0, 1e-14);
  EXPECT_GT(std::abs(evaluate<double, 2>(s, {-1, 1})), 1e-6);
}

TEST(OptimalMask, names_the_constraint_that_cannot_be_met) {
  EXPECT_THAT([] { optimal_mask(1, 3, precision(3)); },
              ThrowsMessage<InvalidInput>(HasSubstr("\"precision 3: the derivative (2, 0) at (-1, 1) must vanish\"")));
  EXPECT_THAT(
      [] {
        optimal_mask(1, 3, {.precision = 0, .zeros = {{{1, 1}, 1}}});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("\"zero of order 1 at (1, 1): the derivative (0, 0)")));
  EXPECT_THAT(
      [] {
        optimal_mask(1, 3, {.zeros = {{{2, 1}, 1}}});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("at (±1, ±1), found (2, 1)")));
}

TEST(OptimalMask, refuses_even_and_small_sizes_and_orders_below_one) {
  EXPECT_THAT([] { optimal_mask(1, 4); }, ThrowsMessage<InvalidInput>(HasSubstr("odd and at least 3, found 4")));
  EXPECT_THAT([] { optimal_mask(1, 1); }, ThrowsMessage<InvalidInput>(HasSubstr("odd and at least 3, found 1")));
  EXPECT_THAT([] { optimal_mask(0, 5); }, ThrowsMessage<InvalidInput>(HasSubstr("at least 1, found 0")));
  EXPECT_THAT([] { truncated_laurent_mask(1, 6); }, ThrowsMessage<InvalidInput>(HasSubstr("found 6")));
}

TEST(OptimalMask, of_order_two_with_zeros_of_order_four_has_limits_that_are_once_differentiable) {
  for (int size : {5, 7, 9}) {
    const auto scheme = custom_scheme(optimal_mask(2, size, precision(3)).mask);
    const auto verdict = smoothness(scheme, {.largest_continuity = 1, .seek_obstacles = false});
    EXPECT_EQ(verdict.continuity, 1) << size;
    for (const auto& proof : verdict.proof) {
      EXPECT_LT(proof.norm, 1);
      EXPECT_EQ(iterated_norm(proof.scheme, proof.power), proof.norm);
      EXPECT_TRUE(is_difference_scheme(proof.scheme, scheme.exact_mask(), proof.order, proof.steps));
    }
  }
}

TEST(OptimalMask, of_order_two_and_size_seven_has_limits_that_are_twice_differentiable) {
  const auto scheme = custom_scheme(optimal_mask(2, 7, precision(3)).mask);
  EXPECT_EQ(smoothness(scheme, {.largest_continuity = 2, .seek_obstacles = false}).continuity, 2);
}

TEST(MultilevelResidual, of_the_17_x_17_optimum_stays_near_one_percent) {
  const std::clock_t start = std::clock();
  const auto mask = to_double(optimal_mask(1, 17).mask);
  const std::array expected = {0.002037, 0.004742, 0.006426, 0.008606, 0.010828};
  for (int k = 1; k <= 5; ++k)
    expect_equal_digits(multilevel_residual(mask, 1, k), expected[static_cast<std::size_t>(k - 1)], 1e-6);
#ifdef NDEBUG  // "20 seconds on a laptop" [Warren & Weimer 2001, sec. 5.2.3]
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 1);
#endif
}

TEST(MultilevelResidual, of_one_round_is_the_residual_norm_and_of_none_zero) {
  const auto mask = to_double(optimal_mask(2, 9).mask);
  EXPECT_DOUBLE_EQ(multilevel_residual(mask, 2, 1), residual_norm(mask, 2));
  EXPECT_EQ(multilevel_residual(mask, 2, 0), 0);
}

TEST(JacobiMask, of_three_rounds_is_nine_by_nine) {
  const auto mask = jacobi_mask(1, {.relaxation = Q(1) / 8, .rounds = 3});
  EXPECT_EQ(mask.size(), (Index<2>{9, 9}));
  EXPECT_EQ(mask, jacobi_mask(1));
}

TEST(JacobiMask, follows_the_printed_iteration) {
  // s = (a l + 1) s - a l[x²,y²], from the bilinear mask [Warren & Weimer 2001, sec. 5.2.2]
  const Q a = Q(1) / 5;
  const auto l = five_point_laplacian();
  auto s = Q(1) / 4 * parse_mask2("1,2,1; 2,4,2; 1,2,1", {-1, -1});
  EXPECT_EQ(jacobi_mask(1, {.relaxation = a, .rounds = 0}), s);
  for (int round = 1; round <= 2; ++round) {
    s = a * (l * s) + s - a * upsampled(l, 2);
    EXPECT_EQ(jacobi_mask(1, {.relaxation = a, .rounds = round}), s);
  }
}

TEST(JacobiMask, has_zeros_of_order_2m) {
  for (int m : {1, 2, 3}) {
    const auto mask = jacobi_mask(m, {.rounds = 2});
    EXPECT_EQ(sum(mask), 4);
    EXPECT_EQ(sum_rule_order(mask), 2 * m);
    EXPECT_EQ(mask.size()[0], 6 * m + 1);
    EXPECT_EQ(jacobi_rounds(m, 6 * m + 1), 2);
  }
}

TEST(JacobiMask, rounds_lessen_the_residual) {
  for (int m : {1, 2})
    for (int rounds = 0; rounds < 6; ++rounds)
      EXPECT_LT(residual_norm(jacobi_mask(m, {.rounds = rounds + 1}), m),
                residual_norm(jacobi_mask(m, {.rounds = rounds}), m));
}

TEST(JacobiMask, says_which_sizes_there_are) {
  EXPECT_THAT([] { jacobi_rounds(2, 7); }, ThrowsMessage<InvalidInput>(HasSubstr("sizes 5, 9, ..., found 7")));
  EXPECT_THAT([] { jacobi_mask(1, {.rounds = -1}); }, ThrowsMessage<InvalidInput>(HasSubstr("found -1")));
}

TEST(LeastSquaresMask, is_stationary_under_every_change_of_a_coefficient) {
  // Σ r ∂r/∂s = 0: the residual is orthogonal to l^m, exactly
  const auto s = least_squares_mask(1, 7);
  const auto r = residual(s, 1);
  const auto gradient = five_point_laplacian() * r;  // l is symmetric: correlation is convolution
  for (int j = -3; j <= 3; ++j)
    for (int i = -3; i <= 3; ++i) EXPECT_EQ((gradient[{i, j}]), 0);
}

TEST(LeastSquaresMask, meets_constraints_and_is_no_better_than_the_optimum) {
  for (int m : {1, 2}) {
    const auto constraints = precision(2 * m - 1);
    const auto s = least_squares_mask(m, 9, constraints);
    EXPECT_GE(sum_rule_order(s), 2 * m);
    EXPECT_GE(residual_norm(s, m), optimal_mask(m, 9, constraints).residual);
  }
}

}  // namespace
}  // namespace batten
