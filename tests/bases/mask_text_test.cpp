// SPDX-License-Identifier: MIT
#include <batten/bases/mask_text.h>
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

TEST(MaskText, reads_as_a_person_writes) {
  EXPECT_EQ(to_string(parse_mask("1/8,1/2,3/4,1/2,1/8", -2)), "1/8 x^-2 + 1/2 x^-1 + 3/4 + 1/2 x + 1/8 x^2");
  EXPECT_EQ(to_string(M(0, {1, -1, 0, -2})), "1 - x - 2 x^3");
  EXPECT_EQ(to_string(M(-1, {-1, 1})), "-x^-1 + 1");
  EXPECT_EQ(to_string(M()), "0");
  EXPECT_EQ(to_string(M(-1, {1, -1}, 1)), "x^(-1/2) - x^(1/2)");
  EXPECT_EQ(to_string(Mask<double>(-1, {0.1, 1, -2.5})), "0.1 x^-1 + 1 - 2.5 x");
  EXPECT_EQ(to_string(M2({-1, 0}, {3, 2}, {0, 1, Q(1, 2), 1, 0, -1})), "1 + 1/2 x + x^-1 y - x y");
}

TEST(MaskText, is_parsed_exactly) {
  EXPECT_EQ(parse_mask("0.125, .5 ,0.75,1/2, 1.25e-1", -2), parse_mask("1/8,1/2,3/4,1/2,1/8", -2));
  EXPECT_EQ(parse_mask("-1/16, +2e2"), M(0, {Q(-1, 16), 200}));
  EXPECT_EQ(parse_mask2("1/2,1/2,0; 1/2,1,1/2;\n0,1/2,1/2", {0, 0}),
            M2({0, 0}, {3, 3}, {Q(1, 2), Q(1, 2), 0, Q(1, 2), 1, Q(1, 2), 0, Q(1, 2), Q(1, 2)}));
  EXPECT_EQ(parse_mask2("1,2;3,4", {-1, 5})[(Index<2>{0, 5})], 2);
}

TEST(MaskText, that_is_no_number_is_named_with_its_place) {
  EXPECT_THAT([] { return parse_mask("1/8,half,3/4"); },
              ThrowsMessage<InvalidInput>("parse_mask: coefficient 2 must be a number such as 3, -1/16 or 0.125, found "
                                          "'half'"));
  EXPECT_THAT([] { return parse_mask2("1,2;3,"); }, ThrowsMessage<InvalidInput>(HasSubstr("coefficient 2 of row 2")));
  EXPECT_THAT([] { return parse_mask2("1,2;3"); },
              ThrowsMessage<InvalidInput>(HasSubstr("as the first, 2, found 1 in row 2")));
  for (const char* bad : {"", "1/0", "1//2", "1.2.3", "e5", "1e", "1e999", "--1", "1/", "nan", ".", "1 2", "1/-2"})
    EXPECT_THROW(parse_rational(bad), InvalidInput) << bad;
}

}  // namespace
}  // namespace batten
