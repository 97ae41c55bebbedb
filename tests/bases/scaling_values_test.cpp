// SPDX-License-Identifier: MIT
#include <batten/bases/mask_values.h>
#include <batten/bases/scaling_values.h>
#include <batten/domains/errors.h>

#include "../support/masks_by_hand.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using namespace test;
using M = Mask<Q>;
using M2 = Mask2<Q>;

TEST(ScalingValues, of_b_splines_are_those_of_the_book) {
  EXPECT_EQ(values_at_integers(b_spline_by_hand(2)), M(1, {1}));
  EXPECT_EQ(values_at_integers(b_spline_by_hand(3)), M(1, {Q(1, 2), Q(1, 2)}));
  EXPECT_EQ(values_at_integers(b_spline_by_hand(4)), M(1, {Q(1, 6), Q(2, 3), Q(1, 6)}));
  EXPECT_EQ(values_at_integers(b_spline_by_hand(5)), M(1, {Q(1, 24), Q(11, 24), Q(11, 24), Q(1, 24)}));
  EXPECT_EQ(values_at_integers(b_spline_by_hand(6)), Q(1, 120) * M(1, {1, 26, 66, 26, 1}));
}

TEST(ScalingValues, of_b_splines_half_way_are_those_of_the_book) {
  const auto half_way = [](int m) { return coset(values_at_level(b_spline_by_hand(m), 1), 1); };
  EXPECT_EQ(half_way(2), M(0, {Q(1, 2), Q(1, 2)}));
  EXPECT_EQ(half_way(3), M(0, {Q(1, 8), Q(3, 4), Q(1, 8)}));
  EXPECT_EQ(half_way(4), M(0, {Q(1, 48), Q(23, 48), Q(23, 48), Q(1, 48)}));
  EXPECT_EQ(half_way(5), M(0, {Q(1, 384), Q(19, 96), Q(115, 192), Q(19, 96), Q(1, 384)}));
  EXPECT_EQ(half_way(6), M(0, {Q(1, 3840), Q(79, 1280), Q(841, 1920), Q(841, 1920), Q(79, 1280), Q(1, 3840)}));
}

TEST(ScalingValues, do_not_depend_on_the_arity_of_the_b_spline) {
  for (int m : {2, 3, 4, 7})
    EXPECT_EQ(values_at_integers(b_spline_by_hand(m, 3)), values_at_integers(b_spline_by_hand(m))) << m;
  EXPECT_EQ(values_at_level(b_spline_by_hand(4, 3), 1, {2}),
            coset(values_at_level(b_spline_by_hand(4, 3), 2, {2}), 0, 3));
}

TEST(ScalingValues, of_a_b_spline_of_order_12_are_eulerian_numbers) {
  // n^12(i) = A(11, i - 1) / 11!, Eulerian numbers
  const std::vector<Q> eulerian = {1, 2036, 152637, 2203488, 9738114, 15724248, 9738114, 2203488, 152637, 2036, 1};
  EXPECT_EQ(values_at_integers(b_spline_by_hand(12)), Q(1, 39916800) * M(1, eulerian));
}

TEST(ScalingValues, of_order_1_are_limits_from_the_right) {
  const auto box = b_spline_by_hand(1);
  EXPECT_EQ(values_at_integers(box, {}, Limit::FromRight), M(0, {1}));
  EXPECT_EQ(values_at_level(box, 2, {}, Limit::FromRight), M(0, {1, 1, 1, 1}));
  EXPECT_THAT([&] { return values_at_integers(box); },
              ThrowsMessage<InvalidInput>(HasSubstr("b-spline is not continuous: no values")));
  EXPECT_EQ(values_at_integers(b_spline_by_hand(2), {1}, Limit::FromRight), M(0, {1, -1}));
  EXPECT_EQ(values_at_integers(box_spline_by_hand({{1, 0}, {0, 1}}), {}, Limit::FromRight), M2::constant(1));
}

TEST(ScalingValues, of_the_four_point_scheme_at_quarters_are_those_of_the_reference) {
  const auto phi = values_at_level(four_point_by_hand(), 2);
  EXPECT_EQ(phi[0], 1);
  EXPECT_EQ(phi[1], Q(27, 32));
  EXPECT_EQ(phi[2], Q(9, 16));
  EXPECT_EQ(phi[3], Q(33, 128));
  EXPECT_EQ(phi[5], Q(-9, 128));
  EXPECT_EQ(phi[6], Q(-1, 16));
  EXPECT_EQ(phi[9], Q(1, 256));
  EXPECT_EQ(phi[12], 0);
}

TEST(ScalingValues, of_the_derivative_of_the_four_point_scheme_are_those_of_the_book) {
  EXPECT_EQ(values_at_integers(four_point_by_hand(), {1}), M(-2, {Q(-1, 12), Q(2, 3), 0, Q(-2, 3), Q(1, 12)}));
  const Scheme of_derivative("derivative", Q(2) * Q(-1, 16) * M(-3, {1, -1, -8, -8, -1, 1}));  // 2 s / (1 + x)
  EXPECT_EQ(values_at_integers(of_derivative), M(-2, {Q(-1, 12), Q(7, 12), Q(7, 12), Q(-1, 12)}));
}

TEST(ScalingValues, of_derivatives_that_do_not_exist_are_refused) {
  EXPECT_THAT([] { return values_at_integers(four_point_by_hand(), {2}); },
              ThrowsMessage<InvalidInput>(HasSubstr("four-point is at most C^1: no second derivative")));
  EXPECT_THAT([] { return values_at_integers(b_spline_by_hand(4), {3}); },
              ThrowsMessage<InvalidInput>(HasSubstr("b-spline is at most C^2: no third derivative")));
  EXPECT_THAT([] { return values_at_integers(b_spline_by_hand(2), {1}); },
              ThrowsMessage<InvalidInput>(HasSubstr("b-spline is at most C^0: no first derivative")));
  EXPECT_THAT(
      [] {
        return values_at_integers(quartic_by_hand(), {3, 0});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("no derivative of order (3, 0)")));
  EXPECT_THAT(
      [] {
        return values_at_integers(butterfly_by_hand(), {2, 0});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("butterfly is not so smooth: no derivative of order (2, 0)")));
  EXPECT_THAT([] { return values_at_integers(b_spline_by_hand(4), {-1}); },
              ThrowsMessage<InvalidInput>(HasSubstr("must not be negative, found -1")));
}

TEST(ScalingValues, of_box_splines_that_are_only_continuous_have_no_derivative) {
  for (const auto& n :
       {box_spline_by_hand({{1, 0}, {0, 1}, {1, 1}}), box_spline_by_hand({{1, 0}, {0, 1}, {1, 1}, {1, 1}})})
    for (const Index<2>& r : {Index<2>{1, 0}, {0, 1}}) {
      EXPECT_EQ(sum(values_at_integers(n)), 1);
      EXPECT_THAT([&] { return values_at_integers(n, r); },
                  ThrowsMessage<InvalidInput>(HasSubstr("box-spline is not so smooth: no derivative of order")));
    }
  EXPECT_NO_THROW(values_at_integers(zwart_powell_by_hand(), {1, 0}));
  EXPECT_THROW(values_at_integers(zwart_powell_by_hand(), {1, 1}), InvalidInput);
}

TEST(ScalingValues, of_the_ternary_four_point_scheme_have_two_derivatives) {
  // w = 1/11, C^2; it reproduces quadratics: Σ_i i^2 n''(-i) = 2 and Σ_i i n'(-i) = 1
  const Q w(1, 11), a = Q(-1, 18) - w / 6, b = Q(13, 18) + w / 2, c = Q(7, 18) - w / 2, d = Q(-1, 18) + w / 6;
  const Scheme ternary("ternary-four-point", Mask<Q>(-5, {d, a, 0, c, b, 1, b, c, 0, a, d}), 3);
  EXPECT_EQ(values_at_integers(ternary), M::constant(1));
  const auto slope = values_at_integers(ternary, {1}), bend = values_at_integers(ternary, {2});
  Q first = 0, second = 0;
  for (int i = -2; i <= 2; ++i) {
    first -= i * slope[i];
    second += i * i * bend[i];
  }
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 2);
  EXPECT_THAT([&] { return values_at_integers(ternary, {3}); },
              ThrowsMessage<InvalidInput>(HasSubstr("ternary-four-point is at most C^2: no third derivative")));
}

TEST(ScalingValues, of_the_four_point_scheme_with_other_tension_have_one_derivative) {
  for (const Q& w : {Q(1, 32), Q(1, 20), Q(1, 10)}) {
    const Scheme tension("four-point", Mask<Q>(-3, {-w, 0, Q(1, 2) + w, 1, Q(1, 2) + w, 0, -w}));
    EXPECT_EQ(values_at_integers(tension), M::constant(1));
    EXPECT_EQ(values_at_integers(tension, {1})[0], 0);
    EXPECT_THAT([&] { return values_at_integers(tension, {2}); },
                ThrowsMessage<InvalidInput>(HasSubstr("four-point is at most C^1: no second derivative")));
  }
}

TEST(ScalingValues, of_a_mask_that_is_not_affine_invariant_are_refused) {
  EXPECT_THAT([] { return values_at_integers(custom_scheme<1>(parse_mask("1/2,3/4,3/4"))); },
              ThrowsMessage<InvalidInput>(HasSubstr("coset 0 of custom sums to 5/4")));
}

TEST(ScalingValues, of_box_splines_are_those_of_the_reference) {
  const auto hat = values_at_level(box_spline_by_hand({{1, 0}, {0, 1}, {1, 1}}), 1);
  EXPECT_EQ((hat[{2, 2}]), 1);
  EXPECT_EQ((hat[{1, 1}]), Q(1, 2));
  const auto zp = values_at_level(zwart_powell_by_hand(), 1);
  EXPECT_EQ((zp[{1, 3}]), Q(1, 2));
  for (const Index<2>& i : {Index<2>{0, 2}, {2, 2}, {0, 4}, {2, 4}}) EXPECT_EQ(zp[i], Q(1, 4));
  EXPECT_EQ((zp[{0, 3}]), Q(3, 8));
  EXPECT_EQ((zp[{1, 2}]), Q(3, 8));
  EXPECT_EQ((zp[{1, 1}]), Q(1, 8));
  EXPECT_EQ((zp[{0, 1}]), Q(1, 16));
  const auto quartic = values_at_level(quartic_by_hand(), 1);
  EXPECT_EQ((quartic[{4, 4}]), Q(1, 2));
  for (const Index<2>& i : {Index<2>{2, 2}, {2, 4}, {4, 2}, {4, 6}, {6, 4}, {6, 6}}) EXPECT_EQ(quartic[i], Q(1, 12));
  EXPECT_EQ((quartic[{3, 3}]), Q(21, 64));
  EXPECT_EQ((quartic[{3, 4}]), Q(21, 64));
}

TEST(ScalingValues, of_derivatives_of_the_quartic_are_those_of_its_polynomial_pieces) {
  // around (1, 1) n is the cone spline c = y^3 (2x - y)/12 for x >= y, x^3 (2y - x)/12 for x <= y [sec. 2.3.3]
  EXPECT_EQ((values_at_integers(quartic_by_hand(), {1, 0})[{1, 1}]), Q(1, 6));  // c_x = y^3/6
  EXPECT_EQ((values_at_integers(quartic_by_hand(), {2, 0})[{1, 1}]), 0);        // c_xx = 0
  EXPECT_EQ((values_at_integers(quartic_by_hand(), {1, 1})[{1, 1}]), Q(1, 2));  // c_xy = y^2/2
  EXPECT_EQ((values_at_integers(quartic_by_hand(), {1, 0})[{2, 2}]), 0);        // by symmetry
}

TEST(ScalingValues, of_centred_half_integer_masks_lie_on_the_integers) {
  const Scheme chaikin("chaikin", centred(b_spline_by_hand(3).exact_mask()));
  EXPECT_EQ(values_at_integers(chaikin), M(-1, {Q(1, 8), Q(3, 4), Q(1, 8)}));
  EXPECT_EQ(values_at_level(chaikin, 1), shifted(values_at_level(b_spline_by_hand(3), 1), {-3}));
  EXPECT_EQ(values_at_level(chaikin, 3), shifted(values_at_level(b_spline_by_hand(3), 3), {-12}));
  EXPECT_EQ(values_at_integers(chaikin, {1}), M(-1, {Q(1, 2), 0, Q(-1, 2)}));
  const Scheme2 both("both",
                     centred(tensor_product(b_spline_by_hand(3).exact_mask(), b_spline_by_hand(4).exact_mask())));
  EXPECT_EQ(values_at_integers(both),
            tensor_product(M(-1, {Q(1, 8), Q(3, 4), Q(1, 8)}), M(-1, {Q(1, 6), Q(2, 3), Q(1, 6)})));
  const Scheme ternary("ternary", M(-3, {Q(1, 6), Q(1, 2), Q(5, 6), Q(5, 6), Q(1, 2), Q(1, 6)}, 1), 3);
  EXPECT_THAT([&] { return values_at_integers(ternary); }, ThrowsMessage<InvalidInput>(HasSubstr("whole powers")));
}

TEST(ScalingValues, sum_to_one_over_the_shifts_and_their_derivatives_to_zero) {
  for (const auto& scheme : {b_spline_by_hand(5), four_point_by_hand(), b_spline_by_hand(4, 3)}) {
    const auto n = values_at_level(scheme, 2), slope = values_at_level(scheme, 2, {1});
    const int step = scheme.arity() * scheme.arity();
    for (int residue = 0; residue < step; ++residue) {
      EXPECT_EQ(sum(coset(n, residue, step)), 1);
      EXPECT_EQ(sum(coset(slope, residue, step)), 0);
    }
  }
  const auto butterfly = values_at_level(butterfly_by_hand(), 1);
  for (const Index<2>& residue : {Index<2>{0, 0}, {0, 1}, {1, 0}, {1, 1}}) EXPECT_EQ(sum(coset(butterfly, residue)), 1);
}

TEST(ScalingValues, satisfy_the_refinement_equation_at_random_dyadic_points) {
  std::mt19937 random(5);
  const auto expect_law = [&](const Scheme2& scheme, const Index<2>& r) {
    const auto n = values_at_level(scheme, 3, r);
    const auto& s = scheme.exact_mask();
    const Q factor = integer_power(2, total(r));
    for (int sample = 0; sample < 20; ++sample) {
      const Index<2> x = {n.first()[0] + static_cast<int>(random() % static_cast<unsigned>(n.size()[0])),
                          n.first()[1] + static_cast<int>(random() % static_cast<unsigned>(n.size()[1]))};
      Q right = 0;
      for (int i = s.first()[0]; i <= s.last()[0]; ++i)
        for (int j = s.first()[1]; j <= s.last()[1]; ++j) right += s[{i, j}] * n[{2 * x[0] - 8 * i, 2 * x[1] - 8 * j}];
      ASSERT_EQ(n[x], factor * right);
    }
  };
  expect_law(zwart_powell_by_hand(), {0, 0});
  expect_law(zwart_powell_by_hand(), {0, 1});
  expect_law(quartic_by_hand(), {1, 1});
  expect_law(butterfly_by_hand(), {1, 0});
  expect_law(quad_by_hand(), {0, 1});
}

TEST(ScalingValues, of_derivatives_are_limits_of_difference_quotients) {
  // central differences of a C^2 piecewise polynomial on the dyadics: n'(x) exactly, up to O(h^2)
  const int level = 10;
  const auto n = values_at_level(b_spline_by_hand(5), level), slope = values_at_level(b_spline_by_hand(5), level, {1});
  const double h = 1. / 1024;
  for (int i = 0; i <= 5 * 1024; i += 37)
    ASSERT_NEAR(static_cast<double>(Q(n[i + 1] - n[i - 1])) / (2 * h), static_cast<double>(slope[i]), h * h) << i;
}

TEST(ScalingValues, of_derivatives_along_directions_that_the_mask_has_not_come_from_moments) {
  // no factor 1 + x: ∂_x is not a difference, and is compared with difference quotients
  const auto skew = box_spline_by_hand({{1, 1}, {-1, 1}, {1, 2}, {0, 1}, {0, 1}, {-1, 2}});
  EXPECT_EQ(derivative_mask(skew.exact_mask(), 2, {1, 0}).remaining, (Index<2>{1, 0}));
  const auto dx = values_at_integers(skew, {1, 0});
  const auto n = limit_values(skew, Mask2<double>::constant(1), 6);
  EXPECT_FALSE(dx.is_zero());
  for (int i = dx.first()[0]; i <= dx.last()[0]; ++i)
    for (int j = dx.first()[1]; j <= dx.last()[1]; ++j)
      ASSERT_NEAR(32 * (n[{64 * i + 1, 64 * j}] - n[{64 * i - 1, 64 * j}]), static_cast<double>(dx[{i, j}]), 1. / 64);
}

TEST(LimitValues, of_the_cubic_are_those_of_the_reference) {
  const M p(0, {1, 3, 2, 5, 6});
  EXPECT_EQ(limit_values(b_spline_by_hand(4), p, 0), M(1, {Q(1, 6), Q(7, 6), Q(5, 2), Q(8, 3), Q(14, 3), Q(29, 6), 1}));
}

TEST(LimitValues, are_sums_of_scaling_functions) {
  const M p(-1, {2, -1, 0, 3});
  for (const auto& scheme :
       {four_point_by_hand(), b_spline_by_hand(3, 3), Scheme("chaikin", centred(b_spline_by_hand(3).exact_mask()))})
    for (int level : {0, 1, 3})
      for (int r : {0, 1}) {
        int step = 1;
        for (int k = 0; k < level; ++k) step *= scheme.arity();
        EXPECT_EQ(limit_values(scheme, p, level, {r}), values_at_level(scheme, level, {r}) * upsampled(p, step));
      }
  const M2 q({0, 1}, {2, 2}, {1, -2, 5, 3});
  EXPECT_EQ(limit_values(butterfly_by_hand(), q, 2), values_at_level(butterfly_by_hand(), 2) * upsampled(q, 4));
  EXPECT_EQ(limit_values(quartic_by_hand(), q, 2, {1, 1}),
            values_at_level(quartic_by_hand(), 2, {1, 1}) * upsampled(q, 4));
}

TEST(LimitValues, over_doubles_agree_with_rationals) {
  const M2 q({0, 1}, {2, 2}, {1, -2, 5, 3});
  for (const Index<2>& r : {Index<2>{0, 0}, {1, 0}, {2, 0}}) {
    const auto exact = to_double(limit_values(quartic_by_hand(), q, 4, r));
    const auto real = limit_values(quartic_by_hand(), to_double(q), 4, r);
    for (int i = exact.first()[0]; i <= exact.last()[0]; ++i)
      for (int j = exact.first()[1]; j <= exact.last()[1]; ++j)
        ASSERT_NEAR((real[{i, j}]), (exact[{i, j}]), 6 * 21 * 40 * 2.3e-16);
  }
  EXPECT_THAT(
      [] {
        return limit_values(quartic_by_hand(), M2({0, 0}, {1, 1}, {1}, {1, 0}), 2);
      },
      ThrowsMessage<InvalidInput>(HasSubstr("half powers")));
  EXPECT_THAT([] { return limit_values(quartic_by_hand(), M2::constant(1), -1); },
              ThrowsMessage<InvalidInput>(HasSubstr("found -1")));
}

}  // namespace
}  // namespace batten
