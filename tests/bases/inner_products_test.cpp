// SPDX-License-Identifier: MIT
#include <batten/bases/inner_products.h>
#include <batten/bases/mask_values.h>
#include <batten/bases/scaling_values.h>
#include <batten/domains/errors.h>

#include "../support/masks_by_hand.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using namespace test;
using M = Mask<Q>;
using M2 = Mask2<Q>;

M products(const Scheme& n, int r, const Scheme& m, int q) { return inner_products<1>({n, {r}}, {m, {q}}); }

TEST(InnerProducts, of_hats_are_those_of_the_book) {
  EXPECT_EQ(products(b_spline_by_hand(2), 0, b_spline_by_hand(2), 0), M(-1, {Q(1, 6), Q(2, 3), Q(1, 6)}));
  EXPECT_EQ(products(b_spline_by_hand(2), 1, b_spline_by_hand(2), 1), M(-1, {-1, 2, -1}));
}

TEST(InnerProducts, of_cubics_are_mass_stiffness_and_bending_rows) {
  const auto cubic = b_spline_by_hand(4);
  EXPECT_EQ(products(cubic, 0, cubic, 0), Q(1, 5040) * M(-3, {1, 120, 1191, 2416, 1191, 120, 1}));
  EXPECT_EQ(products(cubic, 1, cubic, 1), Q(1, 120) * M(-3, {-1, -24, -15, 80, -15, -24, -1}));
  EXPECT_EQ(products(cubic, 2, cubic, 2), Q(1, 6) * M(-3, {1, 0, -9, 16, -9, 0, 1}));
}

TEST(InnerProducts, of_b_splines_are_values_of_the_b_spline_of_the_summed_order) {
  // n^m * n^l reflected is n^(m + l): ∫ n^m n^l(. - i) = n^(m + l)(l + i)
  EXPECT_EQ(products(b_spline_by_hand(1), 0, b_spline_by_hand(3), 0), M(-2, {Q(1, 6), Q(2, 3), Q(1, 6)}));
  EXPECT_EQ(products(b_spline_by_hand(1), 0, b_spline_by_hand(1), 0), M::constant(1));
  EXPECT_EQ(products(b_spline_by_hand(3), 0, b_spline_by_hand(3), 0),
            products(b_spline_by_hand(3, 3), 0, b_spline_by_hand(3, 3), 0));
}

TEST(InnerProducts, of_b_splines_up_to_order_12_have_the_derivatives_of_either_factor) {
  // ∫ n' m(. - i) = -∫ n m'(. - i) and ∫ n^(r) m^(r)(. - i) = (-1)^r ∫ n^(2r) m(. - i)
  for (int m = 1; m <= 12; ++m) {
    const auto n = b_spline_by_hand(m);
    for (int r = 0; r < m; ++r) {
      const auto e = products(n, r, n, r);
      EXPECT_EQ(sum(e), r == 0 ? 1 : 0);
      EXPECT_EQ(e, Q(r % 2 ? -1 : 1) * products(n, 2 * r, n, 0)) << m << " " << r;
      EXPECT_EQ(reflected(e), e);
    }
  }
}

TEST(InnerProducts, of_the_four_point_scheme_and_its_derivative_are_those_of_the_book) {
  const M e = area_form(four_point_by_hand());
  EXPECT_EQ(e, M(-5, {Q(1, 665280), Q(4, 10395), Q(-481, 73920), Q(731, 6930), Q(-3659, 5280), 0, Q(3659, 5280),
                      Q(-731, 6930), Q(481, 73920), Q(-4, 10395), Q(-1, 665280)}));
  EXPECT_EQ(e, products(four_point_by_hand(), 0, four_point_by_hand(), 1));
}

TEST(InnerProducts, of_the_four_point_scheme_exist_up_to_bending) {
  // n'' is square integrable though not continuous: the Sobolev exponent is 2.44
  const auto bending = products(four_point_by_hand(), 2, four_point_by_hand(), 2);
  EXPECT_EQ(sum(bending), 0);
  EXPECT_GT(bending[0], 0);
  EXPECT_THAT([] { return products(four_point_by_hand(), 3, four_point_by_hand(), 3); },
              ThrowsMessage<InvalidInput>(HasSubstr("inner_products: ∫ ∂^(3) n ∂^(3) m must exist")));
  EXPECT_THAT([] { return products(b_spline_by_hand(1), 1, b_spline_by_hand(1), 1); },
              ThrowsMessage<InvalidInput>(HasSubstr("does not for b-spline and b-spline")));
}

TEST(InnerProducts, agree_with_sums_over_a_fine_grid) {
  // trapezoidal sums at spacing 1/64 of two different C^1 functions, one piecewise quadratic
  const auto n = four_point_by_hand(), m = b_spline_by_hand(3);
  const auto e = products(n, 0, m, 1);
  const auto f = limit_values(n, Mask<double>::constant(1), 6), g = limit_values(m, Mask<double>::constant(1), 6, {1});
  for (int i = -6; i <= 3; ++i) {
    double sum = 0;
    for (int k = f.first()[0]; k <= f.last()[0]; ++k) sum += f[k] * g[k - 64 * i] / 64;
    EXPECT_NEAR(sum, static_cast<double>(e[i]), 2e-4) << i;
  }
}

TEST(InnerProducts, of_tensor_products_are_tensor_products) {
  const auto n = b_spline_by_hand(3), m = four_point_by_hand();
  const Scheme2 both("both", tensor_product(n.exact_mask(), m.exact_mask()));
  EXPECT_EQ(inner_products<2>({both, {1, 0}}, {both, {1, 1}}),
            tensor_product(products(n, 1, n, 1), products(m, 0, m, 1)));
  const auto t = b_spline_by_hand(3, 3);
  const Scheme2 ternary("ternary", tensor_product(t.exact_mask(), t.exact_mask()), 3);
  EXPECT_EQ(inner_products<2>({ternary, {2, 0}}, {ternary, {2, 1}}),
            tensor_product(products(n, 2, n, 2), products(n, 0, n, 1)));
}

TEST(InnerProducts, of_three_direction_hats_are_the_seven_point_matrices) {
  // on the triangles of x = i, y = j, x - y = k: mass 1/2 and six times 1/12; Laplacian -1, 4, -1 as for squares
  const auto hat = box_spline_by_hand({{1, 0}, {0, 1}, {1, 1}});
  EXPECT_EQ(inner_products<2>({hat}, {hat}), Q(1, 12) * parse_mask2("1,1,0; 1,6,1; 0,1,1", {-1, -1}));
  EXPECT_EQ(inner_products<2>({hat, {1, 0}}, {hat, {1, 0}}) + inner_products<2>({hat, {0, 1}}, {hat, {0, 1}}),
            parse_mask2("0,-1,0; -1,4,-1; 0,-1,0", {-1, -1}));
}

TEST(InnerProducts, of_the_quartic_are_values_of_the_box_spline_of_twice_the_directions) {
  // n correlated with itself is the box spline of four times each direction, shifted by (4, 4)
  const auto n = quartic_by_hand();
  const auto mass = inner_products<2>({n}, {n});
  auto s = Mask2<Q>::constant(4);
  for (const Index<2>& d : {Index<2>{1, 0}, {0, 1}, {1, 1}})
    s *= power(Q(1, 2) * (M2::constant(1) + M2::monomial(d)), 4);
  EXPECT_EQ(mass, shifted(values_at_integers(Scheme2("twelve", s)), {-4, -4}));
  EXPECT_EQ(sum(mass), 1);
  const auto stiffness = inner_products<2>({n, {1, 0}}, {n, {1, 0}});
  EXPECT_EQ(sum(stiffness), 0);
  EXPECT_EQ(stiffness, Q(-1) * inner_products<2>({n, {2, 0}}, {n}));
  // Σ_i i_x^2 ∫ n_x n_x(. - i) = -2 ∫ n = -2, for Σ_i i_x^2 n(x - i) = x^2 + ... with second derivative 2
  Q second = 0;
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j) second += Q(i * i) * stiffness[{i, j}];
  EXPECT_EQ(second, -2);
}

TEST(InnerProducts, exist_for_schemes_that_no_polynomial_describes) {
  for (const auto& n : {butterfly_by_hand(), quad_by_hand()}) {
    const auto mass = inner_products<2>({n}, {n}), stiffness = inner_products<2>({n, {0, 1}}, {n, {0, 1}});
    EXPECT_EQ(sum(mass), 1);
    EXPECT_EQ(reflected(mass), mass);
    EXPECT_EQ(sum(stiffness), 0);
    EXPECT_GT((stiffness[{0, 0}]), 0);
  }
}

TEST(InnerProducts, of_eight_directions_are_found) {
  for (const auto& n : {box_spline_by_hand({{1, 0}, {1, 0}, {0, 1}, {0, 1}, {1, 1}, {1, 1}, {-1, 1}, {-1, 1}}),
                        box_spline_by_hand({{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {2, 1}, {1, 2}, {-2, 1}, {-1, 2}})}) {
    const auto bending = inner_products<2>({n, {2, 0}}, {n, {2, 0}});
    EXPECT_EQ(sum(bending), 0);
    EXPECT_EQ(reflected(bending), bending);
    EXPECT_EQ(bending, inner_products<2>({n, {4, 0}}, {n}));
    EXPECT_EQ(sum(values_at_integers(n)), 1);
  }
}

TEST(InnerProducts, of_schemes_with_half_shifts_are_those_of_the_shifted_functions) {
  const Scheme chaikin("chaikin", centred(b_spline_by_hand(3).exact_mask()));
  EXPECT_EQ(products(chaikin, 1, chaikin, 1), products(b_spline_by_hand(3), 1, b_spline_by_hand(3), 1));
  // ∫ n^3(x + 3/2) n^2(x + 1 - i) = n^5(5/2 + i)
  const Scheme hat("hat", centred(b_spline_by_hand(2).exact_mask()));
  EXPECT_EQ(products(chaikin, 0, hat, 0), M(-2, {Q(1, 384), Q(19, 96), Q(115, 192), Q(19, 96), Q(1, 384)}));
}

TEST(InnerProducts, of_schemes_of_different_arity_are_refused) {
  EXPECT_THAT([] { return products(b_spline_by_hand(2), 0, b_spline_by_hand(2, 3), 0); },
              ThrowsMessage<InvalidInput>(HasSubstr("same arity, found 2 and 3")));
}

TEST(CellIntegrals, of_the_quadratic_are_the_values_of_the_cubic) {
  EXPECT_EQ(cell_integrals<1>({b_spline_by_hand(3)}), M(0, {Q(1, 6), Q(2, 3), Q(1, 6)}));
  EXPECT_EQ(cell_integrals<1>({b_spline_by_hand(2), {1}}), M(0, {1, -1}));
  EXPECT_EQ(sum(cell_integrals<2>({butterfly_by_hand()})), 1);
}

TEST(Moment, of_b_splines_is_that_of_a_sum_of_uniform_numbers) {
  // mean m/2, variance m/12
  for (int m : {1, 2, 5, 12})
    for (int arity : {2, 3}) {
      const auto n = b_spline_by_hand(m, arity);
      EXPECT_EQ(moment<1>(n, {0}), 1);
      EXPECT_EQ(moment<1>(n, {1}), Q(m, 2));
      EXPECT_EQ(moment<1>(n, {2}), Q(m, 12) + Q(m * m, 4));
    }
  const Scheme chaikin("chaikin", centred(b_spline_by_hand(3).exact_mask()));
  EXPECT_EQ(moment<1>(chaikin, {1}), 0);
  EXPECT_EQ(moment<1>(chaikin, {2}), Q(1, 4));
}

TEST(Moment, of_a_scheme_that_reproduces_cubics_vanishes_up_to_the_third) {
  for (int k = 1; k <= 3; ++k) EXPECT_EQ(moment<1>(four_point_by_hand(), {k}), 0);
  EXPECT_NE(moment<1>(four_point_by_hand(), {4}), 0);
  for (const Index<2>& k : {Index<2>{1, 0}, {0, 2}, {1, 1}, {2, 1}, {0, 3}})
    EXPECT_EQ(moment<2>(butterfly_by_hand(), k), 0);
}

TEST(Moment, of_the_quartic_is_that_of_a_sum_of_uniform_numbers_along_the_directions) {
  EXPECT_EQ(moment<2>(quartic_by_hand(), {1, 0}), 2);
  EXPECT_EQ(moment<2>(quartic_by_hand(), {1, 1}), 4 + Q(1, 6));  // covariance: two directions (1, 1)
  EXPECT_THAT([] { return moment<1>(b_spline_by_hand(2), {-1}); }, ThrowsMessage<InvalidInput>(HasSubstr("found -1")));
}

TEST(EnclosedArea, of_a_unit_square_with_five_fold_corners_is_one) {
  std::vector<Q> x, y;
  for (int corner = 0; corner < 4; ++corner)
    for (int k = 0; k < 5; ++k) {
      x.emplace_back(corner == 1 || corner == 2);
      y.emplace_back(corner >= 2);
    }
  EXPECT_EQ(enclosed_area<Q>(four_point_by_hand(), x, y), 1);
  EXPECT_EQ(enclosed_area<Q>(b_spline_by_hand(4), x, y), 1);
}

TEST(EnclosedArea, of_regular_polygons_tends_to_that_of_the_circle) {
  const auto error = [](int n) {
    std::vector<double> x, y;
    for (int k = 0; k < n; ++k) {
      x.push_back(std::cos(2 * std::numbers::pi * k / n));
      y.push_back(std::sin(2 * std::numbers::pi * k / n));
    }
    return std::abs(enclosed_area<double>(four_point_by_hand(), x, y) - std::numbers::pi);
  };
  for (int n : {6, 12, 24}) EXPECT_LT(error(2 * n), error(n) / 12);  // reproduction of cubics: order four
  EXPECT_LT(error(96), 1e-5);
}

TEST(EnclosedArea, of_linear_splines_is_that_of_the_polygon) {
  const std::vector<Q> x = {0, 4, 4, 1}, y = {0, 0, 3, 2};
  EXPECT_EQ(enclosed_area<Q>(b_spline_by_hand(2), x, y), Q(17, 2));  // shoelace: (12 + (8 - 3))/2
  EXPECT_THAT([&] { return enclosed_area<Q>(b_spline_by_hand(2), x, std::span(y).first(3)); },
              ThrowsMessage<InvalidInput>(HasSubstr("found 4 and 3")));
}

}  // namespace
}  // namespace batten
