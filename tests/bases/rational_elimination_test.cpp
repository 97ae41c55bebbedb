// SPDX-License-Identifier: MIT
#include <batten/bases/rational_elimination.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace batten {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;
using Q = Rational;

TEST(RationalElimination, solves_a_system_by_hand) {
  // x + y/2 = 2, x/3 - y = 1/3
  const std::vector<ExactEquation> equations = {{{{0, 1}, {1, Q(1, 2)}}, 2}, {{{0, Q(1, 3)}, {1, -1}}, Q(1, 3)}};
  EXPECT_THAT(*unique_solution(equations, 2), ElementsAre(Q(13, 7), Q(2, 7)));
}

TEST(RationalElimination, adds_terms_of_the_same_unknown) {
  const std::vector<ExactEquation> equations = {{{{0, 1}, {0, 2}}, 5}};
  EXPECT_THAT(*unique_solution(equations, 1), ElementsAre(Q(5, 3)));
}

TEST(RationalElimination, gives_nothing_when_there_is_a_choice_or_a_contradiction) {
  const ExactEquation sum{{{0, 1}, {1, 1}}, 1}, twice{{{0, 2}, {1, 2}}, 2}, difference{{{0, 1}, {1, -1}}, 0},
      other{{{0, 1}}, 1};
  EXPECT_FALSE(unique_solution(std::vector{sum, twice}, 2));
  EXPECT_TRUE(unique_solution(std::vector{sum, twice, difference}, 2));
  EXPECT_FALSE(unique_solution(std::vector{sum, twice, difference, other}, 2));
  EXPECT_FALSE(unique_solution(std::vector<ExactEquation>{}, 1));
}

TEST(RationalElimination, solves_the_hilbert_matrix_of_order_30) {
  // H_ij = 1/(i + j + 1); the row sums of its inverse are the integers (-1)^(n+i) (n+i)! / ((i!)^2 (n-i-1)!), i from 0
  // [Choi 1983, Tricks or treats with the Hilbert matrix].
  const int n = 30;
  std::vector<ExactEquation> equations;
  for (int i = 0; i < n; ++i) {
    ExactEquation row{{}, 1};
    for (int j = 0; j < n; ++j) row.terms.emplace_back(j, Q(1, i + j + 1));
    equations.push_back(row);
  }
  const auto factorial = [](int k) {
    Integer product = 1;
    for (int m = 2; m <= k; ++m) product *= m;
    return product;
  };
  const auto x = unique_solution(equations, n);
  ASSERT_TRUE(x);
  for (int i = 0; i < n; ++i)
    EXPECT_EQ((*x)[static_cast<std::size_t>(i)],
              Q(((n + i) % 2 ? 1 : -1) * factorial(n + i), factorial(i) * factorial(i) * factorial(n - i - 1)));
}

TEST(RationalElimination, finds_a_chosen_solution_of_200_random_equations) {
  std::mt19937 random(7);
  const int n = 200;
  std::vector<Q> x;
  for (int i = 0; i < n; ++i)
    x.emplace_back(static_cast<int>(random() % 2001) - 1000, 1 + static_cast<int>(random() % 99));
  std::vector<ExactEquation> equations(n);
  for (auto& row : equations)
    for (int k = 0; k < 12; ++k) {
      const int j = static_cast<int>(random() % n);
      row.terms.emplace_back(j, Q(static_cast<int>(random() % 201) - 100, 7));
      row.right += row.terms.back().second * x[static_cast<std::size_t>(j)];
    }
  const auto found = unique_solution(equations, n);
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, x);
}

TEST(RationalElimination, refuses_unknowns_that_do_not_exist) {
  const std::vector<ExactEquation> equations = {{{{2, 1}}, 1}};
  EXPECT_THAT([&] { return unique_solution(equations, 2); },
              ThrowsMessage<InvalidInput>(HasSubstr("numbered 0 .. 1, found 2")));
}

}  // namespace
}  // namespace batten
