// SPDX-License-Identifier: MIT
#include <batten/bases/box_spline.h>
#include <batten/bases/bspline_scheme.h>
#include <batten/bases/exponential_scheme.h>
#include <batten/bases/mask_text.h>
#include <batten/bases/scheme.h>
#include <batten/bases/tension_scheme.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Q = Rational;

TEST(Scheme, of_a_typed_mask_knows_its_support_and_placement) {
  const auto cubic = custom_scheme<1>(parse_mask("1/8,1/2,3/4,1/2,1/8", -2));
  EXPECT_EQ(cubic.support().lower[0], -2);
  EXPECT_EQ(cubic.support().upper[0], 2);
  EXPECT_EQ(cubic.placement(), Placement::Primal);
  EXPECT_FALSE(cubic.is_interpolatory());
  EXPECT_EQ(cubic.mask(7), to_double(cubic.exact_mask()));
  const auto chaikin = custom_scheme<1>(centred(parse_mask("1/4,3/4,3/4,1/4")));
  EXPECT_EQ(chaikin.support().lower[0], Q(-3, 2));
  EXPECT_EQ(chaikin.support().upper[0], Q(3, 2));
  EXPECT_EQ(chaikin.placement(), Placement::Dual);
  EXPECT_TRUE(custom_scheme<1>(parse_mask("1/2,1,1/2", -1)).is_interpolatory());
  const auto ternary = custom_scheme<1>(parse_mask("1/3,2/3,1,2/3,1/3", -2), 3);
  EXPECT_TRUE(ternary.is_interpolatory());
  EXPECT_EQ(ternary.support().upper[0], 1);
  EXPECT_EQ(ternary.mask_sum(), 3);
}

TEST(Scheme, refuses_a_mask_that_does_not_sum_to_the_number_of_new_points) {
  EXPECT_THAT([] { return custom_scheme<1>(parse_mask("1/2,1/2,1/4")); },
              ThrowsMessage<InvalidInput>(HasSubstr("must sum to 2, found 5/4")));
  EXPECT_THAT([] { return custom_scheme<2>(parse_mask2("1,1;1,1"), 3); },
              ThrowsMessage<InvalidInput>(HasSubstr("must sum to 9, found 4")));
  EXPECT_THAT([] { return custom_scheme<1>(parse_mask("1,1"), 4); },
              ThrowsMessage<InvalidInput>(HasSubstr("arity must be 2 or 3, found 4")));
}

TEST(Scheme, that_is_not_affine_invariant_is_refused_with_the_coset_named) {
  EXPECT_NO_THROW(require_affine_invariance(custom_scheme<1>(parse_mask("1/2,1,1/2"))));
  EXPECT_THAT([] { require_affine_invariance(custom_scheme<1>(parse_mask("1/2,3/4,3/4"))); },
              ThrowsMessage<InvalidInput>(HasSubstr("coset 0 of custom sums to 5/4")));
  EXPECT_THAT([] { require_affine_invariance(custom_scheme<2>(parse_mask2("1,1;2,0"))); },
              ThrowsMessage<InvalidInput>(HasSubstr("coset (0, 1) of custom sums to 2")));
}

TEST(Scheme, that_is_not_stationary_or_not_rational_has_no_exact_mask) {
  const Scheme real("real", Mask<double>(0, {0.3, 1, 0.7}));
  EXPECT_THAT([&] { return real.exact_mask(); }, ThrowsMessage<InvalidInput>(HasSubstr("not rational")));
  const Scheme moving("moving", [](int level) { return Mask<double>(0, {1. / level, 1, 1 - 1. / level}); });
  EXPECT_THAT([&] { return moving.exact_mask(); }, ThrowsMessage<InvalidInput>(HasSubstr("not stationary")));
  EXPECT_EQ(moving.mask(4)[0], 0.25);
  EXPECT_THAT([&] { return moving.mask(0); }, ThrowsMessage<InvalidInput>(HasSubstr("start at 1, found 0")));
}

TEST(Scheme, of_a_tensor_product_has_the_product_mask_and_structure) {
  const auto a = bspline_scheme(3), b = bspline_scheme(4);
  const auto product = tensor_product(a, b);
  EXPECT_EQ(product.exact_mask(), tensor_product(a.exact_mask(), b.exact_mask()));
  EXPECT_EQ(product.exact_mask(), box_mask(product.structure().directions));
  // {9, 3, 3, 1} / 16 and its rotations [Warren & Weimer 2001, sec. 7.2]
  EXPECT_EQ(Q(16) * coset(tensor_product(a, a).exact_mask(), {0, 0}), parse_mask2("1,3;3,9"));
  // bicubic: face 1/4, edge {1, 1; 6, 6; 1, 1} / 16, vertex {1, 6, 1; 6, 36, 6; 1, 6, 1} / 64
  const auto bicubic = tensor_product(b, b).exact_mask();
  EXPECT_EQ(Q(64) * coset(bicubic, {0, 0}), parse_mask2("1,6,1;6,36,6;1,6,1"));
  EXPECT_EQ(Q(16) * coset(bicubic, {1, 0}), parse_mask2("1,1;6,6;1,1"));
  EXPECT_EQ(Q(4) * coset(bicubic, {1, 1}), parse_mask2("1,1;1,1"));
  const auto moving = tensor_product(tension_scheme(0.5), centred(b));
  EXPECT_EQ(moving.mask(3), tensor_product(tension_scheme(0.5).mask(3), centred(b).mask(3)));
  EXPECT_THROW(tensor_product(a, bspline_scheme(3, 3)), InvalidInput);
}

TEST(Scheme, that_moves_from_level_to_level_is_centred_on_all_of_them) {
  const auto scheme = centred(exponential_scheme({0., 1., -1.}));
  for (int level : {1, 4}) {
    EXPECT_EQ(scheme.mask(level).first(), Index<1>{-2});
    EXPECT_EQ(scheme.mask(level).half(), Index<1>{1});
  }
}

}  // namespace
}  // namespace batten
