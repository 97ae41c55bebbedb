// SPDX-License-Identifier: MIT
#include <batten/bases/scaling_values.h>
#include <batten/bases/triple_products.h>
#include <batten/domains/errors.h>

#include "../support/masks_by_hand.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using namespace test;

/// Σ_j ∫ a b(. - i) c(. - j) = ∫ a b(. - i), as Σ_j c(. - j) = 1.
template <int D>
LaurentPolynomial<Q, D> summed_over_j(const TripleProducts<D>& products) {
  Terms<D> sums;
  for (const auto& [ij, value] : products.terms()) {
    Index<D> i{};
    std::copy_n(ij.begin(), D, i.begin());
    sums[i] += value;
  }
  return polynomial_of<D>(sums);
}

TEST(TripleProducts, of_hats_are_those_of_their_pieces) {
  // ∫_0^1 x^3 = 1/4 on either side; ∫_0^1 x^2 (1 - x) = 1/12
  const auto hat = b_spline_by_hand(2);
  const TripleProducts<1> t({hat}, {hat}, {hat});
  EXPECT_EQ(t({0}, {0}), Q(1, 2));
  EXPECT_EQ(t({1}, {0}), Q(1, 12));
  EXPECT_EQ(t({1}, {1}), Q(1, 12));
  EXPECT_EQ(t({-1}, {0}), Q(1, 12));
  EXPECT_EQ(t({1}, {-1}), 0);
  EXPECT_EQ(t({2}, {0}), 0);
}

TEST(TripleProducts, of_derivatives_of_hats_are_those_of_their_pieces) {
  const auto hat = b_spline_by_hand(2), box = b_spline_by_hand(1);
  const TripleProducts<1> stiffness({hat, {1}}, {hat, {1}}, {hat});  // ∫ l over the common cells, signed
  EXPECT_EQ(stiffness({0}, {0}), 1);
  EXPECT_EQ(stiffness({0}, {1}), Q(1, 2));
  EXPECT_EQ(stiffness({1}, {0}), Q(-1, 2));
  const TripleProducts<1> advection({hat}, {hat, {1}}, {hat});
  EXPECT_EQ(advection({0}, {0}), 0);
  EXPECT_EQ(advection({1}, {0}), Q(1, 3));  // ∫_0^1 (1 - x)^2
  EXPECT_EQ(advection({1}, {1}), Q(1, 6));
  const TripleProducts<1> on_cells({hat, {1}}, {hat, {1}}, {box});
  EXPECT_EQ(on_cells({0}, {0}), 1);
  EXPECT_EQ(on_cells({0}, {1}), 1);
  EXPECT_EQ(on_cells({1}, {1}), -1);
  EXPECT_EQ(on_cells({1}, {0}), 0);
}

TEST(TripleProducts, summed_over_one_index_are_inner_products) {
  const auto n = b_spline_by_hand(4), m = four_point_by_hand(), l = b_spline_by_hand(3);
  EXPECT_EQ(summed_over_j(TripleProducts<1>({n, {1}}, {m, {1}}, {l})), inner_products<1>({n, {1}}, {m, {1}}));
  EXPECT_EQ(summed_over_j(TripleProducts<1>({m}, {m, {1}}, {m})), area_form(m));
  const auto ternary = b_spline_by_hand(3, 3);
  EXPECT_EQ(summed_over_j(TripleProducts<1>({ternary}, {ternary}, {ternary})), inner_products<1>({ternary}, {ternary}));
}

TEST(TripleProducts, do_not_depend_on_the_order_of_the_factors) {
  const auto n = b_spline_by_hand(4), m = four_point_by_hand();
  const TripleProducts<1> nmm({n, {2}}, {m, {1}}, {m}), mnm({m, {1}}, {n, {2}}, {m});
  for (int i = -8; i <= 8; ++i)
    for (int j = -8; j <= 8; ++j) ASSERT_EQ(nmm({i}, {j}), mnm({-i}, {j - i}));
}

TEST(TripleProducts, of_the_product_rule_sum_to_zero) {
  // ∫ (n m l)' = 0
  const auto n = b_spline_by_hand(5), m = four_point_by_hand(), l = b_spline_by_hand(2);
  const TripleProducts<1> a({n, {1}}, {m}, {l}), b({n}, {m, {1}}, {l}), c({n}, {m}, {l, {1}});
  for (int i = -8; i <= 8; ++i)
    for (int j = -8; j <= 8; ++j) ASSERT_EQ(a({i}, {j}) + b({i}, {j}) + c({i}, {j}), 0);
}

TEST(TripleProducts, agree_with_sums_over_a_fine_grid) {
  // the rectangle rule at spacing 1/64 has an error of order h^2 and less for C^1 functions of bounded support
  const auto m = four_point_by_hand(), q = b_spline_by_hand(3);
  const TripleProducts<1> t({m}, {q, {1}}, {m});
  const auto f = limit_values(m, Mask<double>::constant(1), 6), g = limit_values(q, Mask<double>::constant(1), 6, {1});
  for (int i : {-3, -1, 0, 2})
    for (int j : {-2, 0, 1}) {
      double sum = 0;
      for (int k = f.first()[0]; k <= f.last()[0]; ++k) sum += f[k] * g[k - 64 * i] * f[k - 64 * j] / 64;
      EXPECT_NEAR(sum, static_cast<double>(t({i}, {j})), 2e-4);
    }
}

TEST(TripleProducts, on_the_plane_of_tensor_products_are_products) {
  const auto n = b_spline_by_hand(2), m = b_spline_by_hand(3);
  const Scheme2 nn("nn", tensor_product(n.exact_mask(), n.exact_mask())),
      nm("nm", tensor_product(n.exact_mask(), m.exact_mask()));
  const TripleProducts<2> t({nn, {1, 0}}, {nm, {1, 1}}, {nn});
  const TripleProducts<1> x({n, {1}}, {n, {1}}, {n}), y({n}, {m, {1}}, {n});
  for (const Index<2>& i : {Index<2>{0, 0}, {1, -1}, {-1, 0}, {0, -2}})
    for (const Index<2>& j : {Index<2>{0, 0}, {1, 1}, {-1, 0}, {0, -1}})
      EXPECT_EQ(t(i, j), x({i[0]}, {j[0]}) * y({i[1]}, {j[1]}));
}

TEST(TripleProducts, on_the_plane_agree_on_tensor_products_and_other_schemes) {
  // 1 = Σ_j hat(. - j) on both sides: ∫ f g = Σ_j ∫ f g hat(. - j), f g of tensor products, hat of three directions
  const Scheme2 quadratic("quadratic",
                          tensor_product(b_spline_by_hand(3).exact_mask(), b_spline_by_hand(3).exact_mask()));
  const auto hat = box_spline_by_hand({{1, 0}, {0, 1}, {1, 1}});
  const Factor<2> f{quadratic, {1, 0}}, g{quadratic, {0, 1}};
  EXPECT_EQ(summed_over_j(TripleProducts<2>(f, g, {hat})), inner_products<2>(f, g));
  EXPECT_EQ(summed_over_j(TripleProducts<2>(f, g, {quadratic})), inner_products<2>(f, g));
}

TEST(TripleProducts, of_three_direction_hats_are_those_of_triangles) {
  // ∫ λ_1^a λ_2^b λ_3^c over a triangle of area 1/2: a! b! c! / (a + b + c + 2)!; six triangles around a vertex, two at
  // an edge
  const auto hat = box_spline_by_hand({{1, 0}, {0, 1}, {1, 1}});
  const TripleProducts<2> t({hat}, {hat}, {hat});
  EXPECT_EQ(t({0, 0}, {0, 0}), 6 * Q(6, 120));
  EXPECT_EQ(t({1, 0}, {0, 0}), 2 * Q(2, 120));
  EXPECT_EQ(t({1, 0}, {1, 1}), Q(1, 120));
  EXPECT_EQ(t({1, 0}, {0, 1}), 0);
  const TripleProducts<2> stiffness({hat, {1, 0}}, {hat, {1, 0}}, {hat});  // gradients are constant: λ sums 1/6 each
  EXPECT_EQ(stiffness({1, 0}, {0, 0}), Q(-1, 3));
  EXPECT_EQ(summed_over_j(stiffness), inner_products<2>({hat, {1, 0}}, {hat, {1, 0}}));
}

TEST(TripleProducts, of_the_quartic_sum_to_its_inner_products) {
  const auto n = quartic_by_hand();
  EXPECT_EQ(summed_over_j(TripleProducts<2>({n, {0, 1}}, {n, {0, 1}}, {n})),
            inner_products<2>({n, {0, 1}}, {n, {0, 1}}));
}

TEST(TripleProducts, that_do_not_exist_or_fit_are_refused) {
  const auto hat = b_spline_by_hand(2), box = b_spline_by_hand(1);
  EXPECT_THAT(
      [&] {
        TripleProducts<1>({hat, {2}}, {hat, {1}}, {box});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("must exist, found that it does not for b-spline, b-spline")));
  EXPECT_THAT([&] { TripleProducts<1>({hat}, {b_spline_by_hand(2, 3)}, {hat}); },
              ThrowsMessage<InvalidInput>(HasSubstr("same arity, found 2 and 3")));
  const Scheme chaikin("chaikin", centred(b_spline_by_hand(3).exact_mask()));
  EXPECT_THAT([&] { TripleProducts<1>({hat}, {hat}, {chaikin}); },
              ThrowsMessage<InvalidInput>(HasSubstr("found others in chaikin than in b-spline")));
  EXPECT_THAT([] { TripleProducts<2>({butterfly_by_hand()}, {butterfly_by_hand()}, {butterfly_by_hand()}); },
              ThrowsMessage<InvalidInput>(HasSubstr("at most 6000 values")));
}

}  // namespace
}  // namespace batten
