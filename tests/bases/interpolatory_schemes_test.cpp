// SPDX-License-Identifier: MIT
#include <batten/bases/interpolatory_schemes.h>
#include <batten/bases/mask_division.h>
#include <batten/bases/mask_text.h>
#include <batten/bases/mask_values.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Q = Rational;
using M = Mask<Rational>;
using M2 = Mask2<Rational>;

Q integer_power(const Q& x, int n) {
  Q result = 1;
  for (int k = 0; k < n; ++k) result *= x;
  return result;
}

/// Whether data of x^degree on Z become data of x^degree on Z/arity.
void expect_reproduces(const Scheme& scheme, int degree) {
  const M& s = scheme.exact_mask();
  for (int e = -4; e <= 4; ++e) {
    Q value = 0;
    for (int j = -20; j <= 20; ++j) value += s[e - scheme.arity() * j] * integer_power(Q(j), degree);
    EXPECT_EQ(value, integer_power(Q(e, scheme.arity()), degree)) << "degree " << degree << " at " << e;
  }
}

void expect_reproduces(const Scheme2& scheme, int p, int q) {
  const M2& s = scheme.exact_mask();
  for (int ex = 0; ex <= 1; ++ex)
    for (int ey = 0; ey <= 1; ++ey) {
      Q value = 0;
      for (int i = -4; i <= 4; ++i)
        for (int j = -4; j <= 4; ++j)
          value += s[{ex - 2 * i, ey - 2 * j}] * integer_power(Q(i), p) * integer_power(Q(j), q);
      EXPECT_EQ(value, integer_power(Q(ex, 2), p) * integer_power(Q(ey, 2), q)) << p << " " << q;
    }
}

TEST(FourPointScheme, has_the_printed_mask_and_factors) {
  // [Warren & Weimer 2001, sec. 3.2.4]
  const auto scheme = four_point_scheme();
  EXPECT_EQ(scheme.exact_mask(), parse_mask("-1/16,0,9/16,1,9/16,0,-1/16", -3));
  EXPECT_TRUE(scheme.is_interpolatory());
  for (int degree = 0; degree <= 3; ++degree) expect_reproduces(scheme, degree);
  const M one_plus_x(0, {1, 1});
  const M t1 = exact_quotient(scheme.exact_mask(), one_plus_x);
  EXPECT_EQ(t1, parse_mask("-1/16,1/16,1/2,1/2,1/16,-1/16", -3));
  const M t2 = Q(2) * exact_quotient(t1, one_plus_x);
  EXPECT_EQ(t2, parse_mask("-1/8,1/4,3/4,1/4,-1/8", -3));
  EXPECT_EQ(Q(2) * exact_quotient(t2, one_plus_x), parse_mask("-1/4,3/4,3/4,-1/4", -3));
}

TEST(FourPointScheme, with_tension_keeps_cubics_for_one_sixteenth_only) {
  const M one_plus_x(0, {1, 1});
  const Q w(1, 10);
  const auto scheme = four_point_scheme(w);
  EXPECT_EQ(multiplicity(one_plus_x, scheme.exact_mask()), 2);
  EXPECT_EQ(multiplicity(one_plus_x, four_point_scheme().exact_mask()), 4);
  const M t1 = exact_quotient(scheme.exact_mask(), one_plus_x);
  EXPECT_EQ(absolute_sum(coset(t1, 0)), Q(1, 2) + 2 * w);
  EXPECT_EQ(absolute_sum(coset(t1, 1)), Q(1, 2) + 2 * w);
  const M t2 = Q(2) * exact_quotient(t1, one_plus_x);
  EXPECT_EQ(t2, M(-3, {-2 * w, 4 * w, 1 - 4 * w, 4 * w, -2 * w}));
  EXPECT_EQ(four_point_scheme(0).exact_mask(), parse_mask("1/2,1,1/2", -1));
}

TEST(FourPointScheme, has_the_derived_limit_values) {
  // φ at dyadic points, from the coefficients of enough rounds [Warren & Weimer 2001, sec. 3.2.4]
  const M rounds = iterated(four_point_scheme().exact_mask(), 2);
  EXPECT_EQ(rounds[1], Q(27, 32));
  EXPECT_EQ(rounds[2], Q(9, 16));
  EXPECT_EQ(rounds[3], Q(33, 128));
  EXPECT_EQ(rounds[5], Q(-9, 128));
  EXPECT_EQ(rounds[6], Q(-1, 16));
  EXPECT_EQ(rounds[9], Q(1, 256));
  EXPECT_EQ(four_point_scheme().support().lower[0], -3);
  EXPECT_EQ(four_point_scheme().support().upper[0], 3);
}

TEST(DeslauriersDubucScheme, reproduces_polynomials_through_its_points) {
  EXPECT_EQ(deslauriers_dubuc_scheme(2).exact_mask(), parse_mask("1/2,1,1/2", -1));
  EXPECT_EQ(deslauriers_dubuc_scheme(4).exact_mask(), four_point_scheme().exact_mask());
  for (int points : {2, 4, 6, 8, 12})
    for (int degree = 0; degree < points; ++degree) expect_reproduces(deslauriers_dubuc_scheme(points), degree);
  for (int bad : {0, 3, -2, 66})
    EXPECT_THAT([&] { return deslauriers_dubuc_scheme(bad); },
                ThrowsMessage<InvalidInput>(HasSubstr("even, 2 to 64, found " + std::to_string(bad))));
}

TEST(SixPointScheme, contains_the_quintic_and_the_variational_scheme) {
  EXPECT_EQ(six_point_scheme(Q(3, 256)).exact_mask(), deslauriers_dubuc_scheme(6).exact_mask());
  // one step of local variational subdivision [Kersey 2003] on uniform knots
  EXPECT_EQ(coset(six_point_scheme(Q(1, 96)).exact_mask(), 1), parse_mask("1/96,-9/96,56/96,56/96,-9/96,1/96", -3));
  EXPECT_EQ(six_point_scheme(0).exact_mask(), four_point_scheme().exact_mask());
  for (int degree = 0; degree <= 3; ++degree) expect_reproduces(six_point_scheme(Q(1, 20)), degree);
}

TEST(TernaryFourPointScheme, has_the_printed_rules_and_differences) {
  const Q w(1, 10);
  const auto scheme = ternary_four_point_scheme(w);
  EXPECT_TRUE(scheme.is_interpolatory());
  EXPECT_EQ(scheme.mask_sum(), 3);
  for (int degree = 0; degree <= 2; ++degree) expect_reproduces(scheme, degree);
  const M rule = coset(scheme.exact_mask(), 1, 3);  // p_{3i+1} = Σ_e rule[e] p_{i-e}
  EXPECT_EQ(rule[1], -Q(1, 18) - w / 6);
  EXPECT_EQ(rule[0], Q(13, 18) + w / 2);
  EXPECT_EQ(rule[-1], Q(7, 18) - w / 2);
  EXPECT_EQ(rule[-2], -Q(1, 18) + w / 6);
  // t_3 = 9 s / (1 + x + x^2)^3, its largest coset sum 0.9 for w = 1/10 and 1 at both ends of the C^2 range
  const auto norm_of_third_differences = [](const Q& weight) {
    const M t = Q(9) * exact_quotient(ternary_four_point_scheme(weight).exact_mask(), power(M(0, {1, 1, 1}), 3));
    Q most = 0;
    for (int r : {0, 1, 2}) most = std::max(most, absolute_sum(coset(t, r, 3)));
    return most;
  };
  EXPECT_EQ(norm_of_third_differences(Q(1, 10)), Q(9, 10));
  EXPECT_EQ(norm_of_third_differences(Q(1, 11)), Q(9, 11));
  EXPECT_EQ(norm_of_third_differences(Q(2, 25)), Q(9, 10));
  EXPECT_EQ(norm_of_third_differences(Q(1, 14)), Q(27, 28));
  EXPECT_EQ(norm_of_third_differences(Q(1, 15)), 1);
  EXPECT_EQ(norm_of_third_differences(Q(1, 9)), 1);
}

TEST(ButterflyScheme, has_the_printed_mask) {
  // [Warren & Weimer 2001, sec. 3.3.4], rows from y^-3 up
  const auto scheme = butterfly_scheme();
  EXPECT_EQ(Q(16) * scheme.exact_mask(),
            parse_mask2("0,-1,-1,0,0,0,0; -1,0,2,0,-1,0,0; -1,2,8,8,2,-1,0; 0,0,8,16,8,0,0;"
                        "0,-1,2,8,8,2,-1; 0,0,-1,0,2,0,-1; 0,0,0,0,-1,-1,0",
                        {-3, -3}));
  EXPECT_TRUE(scheme.is_interpolatory());
  for (int p = 0; p <= 3; ++p)
    for (int q = 0; p + q <= 3; ++q) expect_reproduces(scheme, p, q);
  EXPECT_NO_THROW(require_affine_invariance(butterfly_scheme(Q(1, 7))));
}

/// s[x, 1] / 2: the action on cylinders.
M cylinder_mask(const M2& s) {
  M sum;
  for (int j = s.first()[1]; j <= s.last()[1]; ++j)
    for (int i = s.first()[0]; i <= s.last()[0]; ++i) sum += M::monomial({i}, s[{i, j}] / 2);
  return sum;
}

TEST(ButterflyScheme, acts_on_cylinders_as_the_four_point_scheme) {
  EXPECT_EQ(cylinder_mask(butterfly_scheme().exact_mask()), four_point_scheme().exact_mask());
}

TEST(QuadInterpolatoryScheme, has_the_printed_rules) {
  // [Warren & Weimer 2001, sec. 3.3.4]
  const auto scheme = quad_interpolatory_scheme();
  const M2& s = scheme.exact_mask();
  EXPECT_TRUE(scheme.is_interpolatory());
  EXPECT_EQ(Q(16) * coset(s, {1, 0}), parse_mask2("-1,9,9,-1", {-2, 0}));
  EXPECT_EQ(Q(32) * coset(s, {1, 1}), parse_mask2("0,-1,-1,0;-1,10,10,-1;-1,10,10,-1;0,-1,-1,0", {-2, -2}));
  EXPECT_EQ(s, swapped(s));
  EXPECT_EQ(s, reflected(s));
  EXPECT_EQ(cylinder_mask(s), four_point_scheme().exact_mask());
  for (int p = 0; p <= 3; ++p)
    for (int q = 0; p + q <= 3; ++q) expect_reproduces(scheme, p, q);
}

/// The largest n for which all derivatives of order below n vanish at (-1, 1), (1, -1) and (-1, -1).
int zero_order(const M2& s) {
  for (int n = 0;; ++n)
    for (int i = 0; i <= n; ++i)
      for (const auto& [x, y] : {std::pair{-1, 1}, {1, -1}, {-1, -1}})
        if (evaluate(derivative(s, {i, n - i}), {Q(x), Q(y)}) != 0) return n;
}

TEST(InterpolatoryScheme, of_two_variables_has_zeros_of_order_four) {
  EXPECT_EQ(zero_order(butterfly_scheme().exact_mask()), 4);
  EXPECT_EQ(zero_order(quad_interpolatory_scheme().exact_mask()), 4);  // the source says three
  EXPECT_EQ(zero_order(butterfly_scheme(Q(1, 10)).exact_mask()), 2);
}

}  // namespace
}  // namespace batten
