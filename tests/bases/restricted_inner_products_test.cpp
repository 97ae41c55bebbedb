// SPDX-License-Identifier: MIT
#include <batten/bases/restricted_inner_products.h>
#include <batten/bases/spline_pieces.h>
#include <batten/domains/errors.h>

#include "../support/masks_by_hand.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using namespace test;
using Matrix = std::vector<std::vector<Q>>;

TEST(RestrictedProducts, of_quadratics_are_the_energy_matrix_of_natural_cubics) {
  const auto n = b_spline_by_hand(3);
  const auto E = half_line_inner_products({n, {2}}, {n, {2}});
  EXPECT_EQ(E.first_row, -2);
  EXPECT_EQ(E.first_column, -2);
  EXPECT_EQ(E.boundary, (Matrix{{1, -2, 1}, {-2, 5, -4, 1}}));
  EXPECT_EQ(E.interior, Mask<Q>(-2, {1, -4, 6, -4, 1}));
}

TEST(RestrictedProducts, on_an_interval_have_both_ends) {
  const auto n = b_spline_by_hand(3);
  const auto [rows, columns, E] = restricted_inner_products<1>({n, {2}}, {n, {2}}, {4});
  EXPECT_EQ(rows.front(), Index<1>{-2});
  EXPECT_EQ(rows.back(), Index<1>{3});
  EXPECT_EQ(rows, columns);
  EXPECT_EQ(E, (Matrix{{1, -2, 1, 0, 0, 0},
                       {-2, 5, -4, 1, 0, 0},
                       {1, -4, 6, -4, 1, 0},
                       {0, 1, -4, 6, -4, 1},
                       {0, 0, 1, -4, 5, -2},
                       {0, 0, 0, 1, -2, 1}}));
}

/// arity^(1 - r - q) E = S~^T E S~, of which the rows up to `size` are finite sums.
void expect_two_scale_law(const Factor<1>& n, const Factor<1>& m) {
  const auto E = half_line_inner_products(n, m);
  const auto entry = [&](int i, int j) -> Q {
    const auto a = static_cast<std::size_t>(i - E.first_row), b = static_cast<std::size_t>(j - E.first_column);
    if (a >= E.boundary.size()) return E.interior[j - i];
    return b < E.boundary[a].size() ? E.boundary[a][b] : Q(0);
  };
  const auto &s = n.scheme.exact_mask(), &t = m.scheme.exact_mask();
  const int arity = n.scheme.arity(), order = n.derivative[0] + m.derivative[0];
  Q scale = arity;
  for (int k = 0; k < order; ++k) scale /= arity;
  for (int i = E.first_row; i < 6; ++i)
    for (int j = E.first_column; j < 6; ++j) {
      Q sum = 0;
      for (int k = std::max(E.first_row, arity * i + s.first()[0]); k <= arity * i + s.last()[0]; ++k)
        for (int l = std::max(E.first_column, arity * j + t.first()[0]); l <= arity * j + t.last()[0]; ++l)
          sum += s[k - arity * i] * entry(k, l) * t[l - arity * j];
      ASSERT_EQ(sum, scale * entry(i, j)) << i << " " << j;
    }
}

TEST(RestrictedProducts, satisfy_the_two_scale_law) {
  expect_two_scale_law({b_spline_by_hand(3), {2}}, {b_spline_by_hand(3), {2}});
  expect_two_scale_law({b_spline_by_hand(4), {1}}, {b_spline_by_hand(2)});
  expect_two_scale_law({four_point_by_hand(), {1}}, {four_point_by_hand(), {1}});
  expect_two_scale_law({four_point_by_hand(), {2}}, {four_point_by_hand(), {2}});
  expect_two_scale_law({b_spline_by_hand(4, 3), {2}}, {b_spline_by_hand(4, 3)});
}

TEST(RestrictedProducts, away_from_the_ends_are_those_of_the_whole_line) {
  const auto n = four_point_by_hand();
  const auto [rows, columns, E] = restricted_inner_products<1>({n}, {n, {1}}, {9});
  const auto e = area_form(n);
  for (std::size_t a = 0; a < rows.size(); ++a) {
    if (rows[a][0] < 3 || rows[a][0] > 6) continue;
    for (std::size_t b = 0; b < columns.size(); ++b) EXPECT_EQ(E[a][b], e[columns[b][0] - rows[a][0]]);
  }
}

TEST(RestrictedProducts, of_polynomials_are_their_integrals) {
  // Σ_i n(x - i) = 1 and Σ_i i n(x - i) = x for the four-point scheme: row and column sums give ∫_0^N of 1, x, x^2
  const auto n = four_point_by_hand();
  const auto [rows, columns, E] = restricted_inner_products<1>({n}, {n}, {5});
  Q one = 0, x = 0, square = 0;
  for (std::size_t a = 0; a < rows.size(); ++a)
    for (std::size_t b = 0; b < columns.size(); ++b) {
      one += E[a][b];
      x += rows[a][0] * E[a][b];
      square += rows[a][0] * columns[b][0] * E[a][b];
    }
  EXPECT_EQ(one, 5);
  EXPECT_EQ(x, Q(25, 2));
  EXPECT_EQ(square, Q(125, 3));
}

TEST(RestrictedProducts, of_b_splines_agree_with_those_of_their_pieces) {
  // away from repeated knots the clamped basis on [0, 4m] is that of the shifts; the interval [m, 3m] has no other
  for (int m = 2; m <= 6; ++m)
    for (int r = 0; r < m; ++r) {
      std::vector<int> knots(static_cast<std::size_t>(4 * m + 1));
      std::iota(knots.begin(), knots.end(), 0);
      const auto pieces = spline_pieces(knots, m - 1);
      const CellProducts<1> products({b_spline_by_hand(m), {r}}, {b_spline_by_hand(m)});
      const auto& piece = pieces[static_cast<std::size_t>(2 * m)].coefficients;
      for (int a = 0; a < m; ++a)
        for (int b = 0; b < m; ++b) {
          Q integral = 0;  // function a of the piece is n(x + m - 1 - a) on the cell
          const auto &p = piece[static_cast<std::size_t>(a)], &q = piece[static_cast<std::size_t>(b)];
          for (std::size_t k = static_cast<std::size_t>(r); k < p.size(); ++k) {
            Q c = p[k];
            for (int d = 0; d < r; ++d) c *= static_cast<int>(k) - d;
            for (std::size_t l = 0; l < q.size(); ++l) integral += c * q[l] / Q(static_cast<int>(k + l) - r + 1);
          }
          ASSERT_EQ(products({m - 1 - a}, {m - 1 - b}), integral) << m << " " << r;
        }
    }
}

TEST(RestrictedProducts, of_hats_on_a_square_are_those_of_finite_elements) {
  // natural boundary: corner 2/3 and edges of the bilinear element's stiffness; three-direction hats as in 6.4
  const auto hat = box_spline_by_hand({{1, 0}, {0, 1}, {1, 1}});
  const auto x = restricted_inner_products<2>({hat, {1, 0}}, {hat, {1, 0}}, {2, 2});
  const auto y = restricted_inner_products<2>({hat, {0, 1}}, {hat, {0, 1}}, {2, 2});
  ASSERT_EQ(x.rows.size(), 9U);  // the vertices of a 2 x 2 square: n(x - i) has its vertex at i + (1, 1)
  EXPECT_EQ(x.rows.front(), (Index<2>{-1, -1}));
  const Matrix expected = {{1, Q(-1, 2), 0, Q(-1, 2), 0, 0, 0, 0, 0}, {Q(-1, 2), 2, Q(-1, 2), 0, -1, 0, 0, 0, 0}};
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t b = 0; b < 9; ++b) EXPECT_EQ(x.E[a][b] + y.E[a][b], expected[a][b]) << a << " " << b;
  Q centre = x.E[4][4] + y.E[4][4];
  EXPECT_EQ(centre, 4);
}

TEST(RestrictedProducts, of_the_quartic_on_a_square_vanish_on_polynomials) {
  // Σ_i n(x - i) = 1 and Σ_i (i + 2) n(x - i) = x: the stiffness of x is the area
  const auto n = quartic_by_hand();
  const auto [rows, columns, E] = restricted_inner_products<2>({n, {1, 0}}, {n, {1, 0}}, {2, 1});
  Q energy = 0;
  for (std::size_t a = 0; a < rows.size(); ++a) {
    EXPECT_EQ(std::accumulate(E[a].begin(), E[a].end(), Q(0)), 0);
    for (std::size_t b = 0; b < columns.size(); ++b) energy += rows[a][0] * columns[b][0] * E[a][b];
  }
  EXPECT_EQ(energy, 2);
}

TEST(SupportCells, of_a_hexagon_are_not_those_of_its_box) {
  EXPECT_EQ(support_cells(box_spline_by_hand({{1, 0}, {0, 1}, {1, 1}})).size(), 4U);
  EXPECT_EQ(support_cells(zwart_powell_by_hand()).size(), 9U);  // the corner cells of the octagon are halved
  EXPECT_EQ(support_cells(quartic_by_hand()).size(), 14U);      // 16 less two whole cells cut off
  EXPECT_EQ(support_cells(b_spline_by_hand(3)), (std::vector<Index<1>>{{0}, {1}, {2}}));
}

TEST(RestrictedProducts, of_bad_input_are_refused) {
  const auto n = b_spline_by_hand(2);
  EXPECT_THAT([&] { restricted_inner_products<1>({n}, {n}, {0}); }, ThrowsMessage<InvalidInput>(HasSubstr("found 0")));
  EXPECT_THAT(
      [&] {
        half_line_inner_products({n, {2}}, {n, {2}});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("found that it does not for unit cell, b-spline and b-spline")));
  const Scheme chaikin("chaikin", centred(b_spline_by_hand(3).exact_mask()));
  EXPECT_THAT([&] { half_line_inner_products({chaikin}, {chaikin}); },
              ThrowsMessage<InvalidInput>(HasSubstr("whole powers, found half ones in chaikin")));
}

}  // namespace
}  // namespace batten
