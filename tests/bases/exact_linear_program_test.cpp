// SPDX-License-Identifier: MIT
#include <batten/bases/exact_linear_program.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Q = Rational;

/// max 3x + 2y, x + y <= 4, x + 3y <= 6, x <= 3: the corner (3, 1).
LinearProgram textbook() {
  return {{-3, -2, 0, 0, 0}, 0, {{{{0, 1}, {1, 1}, {2, 1}}, 4}, {{{0, 1}, {1, 3}, {3, 1}}, 6}, {{{0, 1}, {4, 1}}, 3}}};
}

TEST(ExactLinearProgram, finds_the_corner) {
  const auto found = optimum(textbook());
  EXPECT_EQ(found.cost, -11);
  EXPECT_EQ(found.values[0], 3);
  EXPECT_EQ(found.values[1], 1);
}

TEST(ExactLinearProgram, gives_thirds_as_thirds) {
  // min t, t >= |x - 1|, t >= |2x + 1|: x = 0, t = 1; with 1/3 for the 1 of the first: x = -2/9, t = 5/9
  const LinearProgram program{{0, 1, 0, 0, 0, 0},
                              2,
                              {{{{1, 1}, {0, -1}, {2, -1}}, Q(-1) / 3},
                               {{{1, 1}, {0, 1}, {3, -1}}, Q(1) / 3},
                               {{{1, 1}, {0, -2}, {4, -1}}, 1},
                               {{{1, 1}, {0, 2}, {5, -1}}, -1}}};
  const auto found = optimum(program);
  EXPECT_EQ(found.values[0], Q(-2) / 9);
  EXPECT_EQ(found.cost, Q(5) / 9);
}

TEST(ExactLinearProgram, takes_an_equation_twice) {
  auto program = textbook();
  program.equations.push_back(program.equations.front());
  EXPECT_EQ(optimum(program).cost, -11);
}

TEST(ExactLinearProgram, proof_fails_for_other_values) {
  auto found = optimum(textbook());
  EXPECT_TRUE(is_proved(found, textbook()));
  found.values[0] -= 1;
  EXPECT_FALSE(is_proved(found, textbook()));
}

TEST(ExactLinearProgram, says_why_there_is_no_optimum) {
  EXPECT_THAT([] { optimum({{0}, 0, {{{{0, 1}}, -1}}}); }, ThrowsMessage<SolverError>(HasSubstr("no choice")));
  EXPECT_THAT(
      [] {
        optimum({{-1, 0}, 0, {{{{0, 1}, {1, -1}}, 0}}});
      },
      ThrowsMessage<SolverError>(HasSubstr("lower bound")));
  EXPECT_THAT([] { optimum({{1}, 0, {{{{1, 1}}, 1}}}); }, ThrowsMessage<InvalidInput>(HasSubstr("found 1")));
}

}  // namespace
}  // namespace batten
