// SPDX-License-Identifier: MIT
#include <batten/bases/certificate_check.h>
#include <batten/bases/difference_scheme.h>

#include "../support/known_masks.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace batten {
namespace {

using namespace test;
using testing::HasSubstr;
using Q = Rational;

const Mask<Q> four_point = four_point_mask(Q(1, 16));

Contraction<1> contraction(const Mask<Q>& t, int order, int power, const Q& norm) {
  return {order, 1, power, norm, MaskMatrix<Q, 1>(1, 1, {t})};
}

TEST(CertificateCheck, accepts_the_contraction_of_the_source) {
  EXPECT_EQ(fault_of(contraction(parse_mask("-1/8,1/4,3/4,1/4,-1/8", -3), 2, 2, Q(3, 4)), four_point), "");
}

TEST(CertificateCheck, refuses_contractions_that_are_none) {
  const auto t2 = difference_scheme(four_point, 2), t3 = difference_scheme(four_point, 3);
  EXPECT_THAT(fault_of(contraction(t2, 2, 1, 1), four_point), HasSubstr("not below 1"));
  EXPECT_THAT(fault_of(contraction(t2, 2, 2, Q(1, 2)), four_point), HasSubstr("the norm is 3/4, not 1/2"));
  EXPECT_THAT(fault_of(contraction(t3, 3, 8, Q(1, 2)), four_point), HasSubstr("the norm is 1"));
  EXPECT_THAT(fault_of(contraction(t2, 1, 2, Q(3, 4)), four_point), HasSubstr("not that of differences of order 1"));
  EXPECT_THAT(fault_of(contraction(t2 * Q(1, 2), 2, 1, Q(1, 2)), four_point), HasSubstr("not that of differences"));
  EXPECT_THAT(fault_of(contraction(t2, 2, 2, Q(3, 4)), four_point_mask(Q(1, 32))), HasSubstr("not that of"));
  EXPECT_THAT(fault_of(contraction(t2, 2, 40, Q(3, 4)), four_point), HasSubstr("1 to 12 rounds"));
}

TEST(CertificateCheck, refuses_verdicts_with_orders_left_out) {
  auto verdict = smoothness(custom_scheme<1>(bspline_mask(4)));
  ASSERT_EQ(fault_of(verdict, bspline_mask(4)), "");
  verdict.continuity = 3;
  EXPECT_THAT(fault_of(verdict, bspline_mask(4)), HasSubstr("each order up to 4"));
  verdict.continuity = 2;
  verdict.proof[1] = verdict.proof[0];
  EXPECT_THAT(fault_of(verdict, bspline_mask(4)), HasSubstr("must be 1, 2, ..."));
}

TEST(CertificateCheck, refuses_obstacles_that_are_none) {
  EXPECT_EQ(fault_of(Roughness<1>{{1, {0}}, Q(1, 4)}, 2, four_point), "");
  EXPECT_THAT(fault_of(Roughness<1>{{1, {0}}, Q(1, 2)}, 1, four_point), HasSubstr("no eigenvalue besides"));
  EXPECT_THAT(fault_of(Roughness<1>{{1, {0}}, Q(1, 8)}, 2, four_point), HasSubstr("must be at least 1/4"));
  EXPECT_THAT(fault_of(Roughness<1>{{1, {5}}, Q(1, 4)}, 2, four_point), HasSubstr("does not lie in"));
  EXPECT_THAT(fault_of(Roughness<1>{{1, {0}}, Q(1)}, 0, bspline_mask(3)), HasSubstr("no eigenvalue besides"));
  // a cubic B-spline is C^2 but not C^3; the alternating data of Zwart-Powell have no limit and prove nothing
  EXPECT_NE(fault_of(Roughness<1>{{1, {0}}, Q(1, 4)}, 2, bspline_mask(4)), "");
  EXPECT_EQ(fault_of(Roughness<1>{{1, {0}}, Q(1, 8)}, 3, bspline_mask(4)), "");
  EXPECT_NE(fault_of(Roughness<2>{{1, {0, 0}}, Q(1, 2)}, 1, zwart_powell_mask()), "");
}

TEST(CertificateCheck, refuses_coset_sums_that_are_not_so) {
  EXPECT_EQ(fault_of(CosetDefect<1>{{0}, Q(5, 4)}, parse_mask("1/2,3/4,3/4")), "");
  EXPECT_THAT(fault_of(CosetDefect<1>{{1}, Q(5, 4)}, parse_mask("1/2,3/4,3/4")), HasSubstr("sums to 3/4"));
  EXPECT_THAT(fault_of(CosetDefect<1>{{0}, Q(1)}, four_point), HasSubstr("as it should"));
}

TEST(CertificateCheck, refuses_box_splines_with_directions_that_are_none) {
  const BoxFactors<1> box{{{1}, {1}}, contraction(parse_mask("1/2,1/2"), 1, 1, Q(1, 2))};
  EXPECT_EQ(fault_of(box, bspline_mask(2)), "");
  auto forged = box;
  forged.directions.push_back({0});  // (1 + x^0)/2 = 1 leaves the mask as it is
  EXPECT_THAT(fault_of(forged, bspline_mask(2)), HasSubstr("not the product"));
  forged = box;
  forged.convergence.order = 2;
  EXPECT_THAT(fault_of(forged, bspline_mask(2)), HasSubstr("order 1"));
}

TEST(CertificateCheck, refuses_polytopes_that_are_not_kept) {
  const auto bounds = hoelder_bounds(custom_scheme<1>(four_point));
  ASSERT_EQ(fault_of(bounds, four_point), "");
  auto forged = bounds;
  forged.lower_proof.radius *= Q(99, 100);
  EXPECT_THAT(fault_of(forged, four_point), HasSubstr("not shown to lie inside"));
  forged = bounds;
  forged.lower_proof.images.pop_back();
  EXPECT_THAT(fault_of(forged, four_point), HasSubstr("sizes and indices"));
  forged = bounds;
  forged.lower_proof.images[0].indices.assign(1, 1000);
  EXPECT_THAT(fault_of(forged, four_point), HasSubstr("sizes and indices"));
  forged = bounds;
  forged.lower_proof.window.pop_back();
  EXPECT_NE(fault_of(forged, four_point), "");
  forged = bounds;
  forged.lower_proof.order = 5;
  EXPECT_THAT(fault_of(forged, four_point), HasSubstr("sum rules"));
  forged = bounds;
  forged.lower_proof.vertices.front().front() += 1;
  EXPECT_NE(fault_of(forged, four_point), "");
}

TEST(CertificateCheck, refuses_bounds_beyond_their_proofs) {
  const auto bounds = hoelder_bounds(custom_scheme<1>(six_point_mask(Q(1, 20))));
  ASSERT_EQ(fault_of(bounds, six_point_mask(Q(1, 20))), "");
  auto forged = bounds;
  forged.lower = 2;
  EXPECT_THAT(fault_of(forged, six_point_mask(Q(1, 20))), HasSubstr("larger than what is proved"));
  forged = bounds;
  forged.upper = 1;
  EXPECT_THAT(fault_of(forged, six_point_mask(Q(1, 20))), HasSubstr("smaller than what is proved"));
  forged = bounds;
  forged.upper_proof.radius *= Q(11, 10);
  EXPECT_THAT(fault_of(forged, six_point_mask(Q(1, 20))), HasSubstr("upper bound: no eigenvalue"));
}

TEST(CertificateCheck, refuses_a_window_in_which_differences_do_not_show) {
  // On the two indices of [0, 1] linear interpolation leaves nothing modulo linear functions: kinks lie between.
  InvariantPolytope<1> polytope{2, {{0}, {1}}, Q(1, 100), Q(1, 10), {}, {}};
  EXPECT_THAT(fault_of(polytope, parse_mask("1/2,1,1/2", -1)), HasSubstr("misses differences"));
}

}  // namespace
}  // namespace batten
