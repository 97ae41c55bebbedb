// SPDX-License-Identifier: MIT
#include <batten/bases/certificate_check.h>
#include <batten/bases/hoelder.h>
#include <batten/domains/errors.h>

#include "../support/known_masks.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

using namespace test;
using Q = Rational;

/// That the bounds are proved, no farther apart than 0.05, and hold the exponent.
template <int D>
void expect_exponent(double exponent, const LaurentPolynomial<Q, D>& s, int arity = 2) {
  const auto bounds = hoelder_bounds(SubdivisionScheme<D>("test", s, arity));
  EXPECT_EQ(fault_of(bounds, s, arity), "");
  EXPECT_LE(bounds.upper - bounds.lower, 0.05);
  EXPECT_LE(bounds.lower, exponent);
  EXPECT_GE(bounds.upper, exponent - 1e-6);
}

TEST(Hoelder, exponent_of_the_bspline_of_order_m_is_m_minus_1) {
  for (int m = 2; m <= 8; ++m) expect_exponent(m - 1, bspline_mask(m));
}

TEST(Hoelder, exponent_of_the_four_point_scheme_is_2) { expect_exponent(2, four_point_mask(Q(1, 16))); }

TEST(Hoelder, exponent_of_the_four_point_scheme_with_less_tension_follows_its_eigenvalue) {
  // second differences scale by λ/2 at 0, λ² - λ + 4w = 0: λ = (1 + √(1-16w))/2
  const double w = 1. / 32, lambda = (1 + std::sqrt(1 - 16 * w)) / 2;
  expect_exponent(1 - std::log2(lambda), four_point_mask(Q(1, 32)));
}

TEST(Hoelder, exponent_of_deslauriers_dubuc_is_the_literature_s) {
  expect_exponent(std::log2(64. / 9), deslauriers_dubuc_mask());  // 2.830 [Daubechies & Lagarias 1992b]
}

TEST(Hoelder, exponent_of_kersey_s_six_point_scheme_is_2_63) {
  const auto bounds = hoelder_bounds(custom_scheme<1>(six_point_mask(Q(1, 96))));
  EXPECT_EQ(fault_of(bounds, six_point_mask(Q(1, 96))), "");
  EXPECT_NEAR(bounds.lower, 2.631, 0.001);
  EXPECT_NEAR(bounds.upper, 2.631, 0.001);
}

TEST(Hoelder, exponent_of_the_six_point_filter_of_seed_000_is_below_2) {
  // joint spectral radius of third differences in [1.0807, 1.1118]: exponent in 2 - log2 of it
  const auto bounds = hoelder_bounds(custom_scheme<1>(six_point_mask(Q(1, 20))));
  EXPECT_EQ(fault_of(bounds, six_point_mask(Q(1, 20))), "");
  EXPECT_GE(bounds.lower, 2 - std::log2(1.1118));
  EXPECT_LE(bounds.upper, 2 - std::log2(1.0807) + 1e-4);
  EXPECT_LE(bounds.upper - bounds.lower, 0.05);
}

TEST(Hoelder, exponent_of_the_ternary_four_point_scheme_is_above_2_by_its_eigenvalue_w) {
  // third differences scale by w at 0 for w >= 1/11: exponent -log3(w)
  for (const Q& w : {Q(1, 11), Q(1, 10), Q(1, 9)})
    expect_exponent(-std::log(static_cast<double>(w)) / std::log(3), ternary_four_point_mask(w), 3);
}

TEST(Hoelder, exponent_of_box_splines_is_that_of_their_pieces) {
  expect_exponent(1, three_direction_linear_mask());
  expect_exponent(2, zwart_powell_mask());
  expect_exponent(3, three_direction_quartic_mask());
}

TEST(Hoelder, exponent_of_interpolatory_surfaces_is_2) {
  // at most that of the four-point scheme on cylinders; 1.44 in the literature is the embedding of a Sobolev exponent
  expect_exponent(2, butterfly_mask());
  expect_exponent(2, quad_interpolatory_mask());
}

TEST(Hoelder, exponent_needs_a_convergent_scheme) {
  EXPECT_THROW(hoelder_bounds(custom_scheme<1>(bspline_mask(1))), SolverError);
  EXPECT_THROW(hoelder_bounds(custom_scheme<1>(parse_mask("1/2,3/4,3/4"))), InvalidInput);
}

}  // namespace
}  // namespace batten
