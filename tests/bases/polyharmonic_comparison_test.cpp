// SPDX-License-Identifier: MIT
#include <batten/bases/optimal_mask.h>
#include <batten/bases/polyharmonic_comparison.h>
#include <batten/bases/polyharmonic_scheme.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(PolyharmonicComparison, laurent_is_up_to_four_times_the_optimum_and_jacobi_five_to_21_times_laurent) {
  // the computed numbers of variational.md, section 5.2, N = 5 .. 21
  const auto table = compare_sizes(1, std::array{5, 9, 13, 17, 21});
  ASSERT_EQ(table.size(), 5);
  for (const auto& [size, residual] : table) {
    const double laurent = residual.laurent / residual.optimal, jacobi = residual.jacobi.value() / residual.laurent;
    EXPECT_GE(laurent, 1.4) << size;
    EXPECT_LE(laurent, 3.6) << size;
    EXPECT_GE(jacobi, 5) << size;
    EXPECT_LE(jacobi, 21.5) << size;
    EXPECT_GE(residual.least_squares, residual.optimal) << size;
  }
  EXPECT_NEAR(table.front().residual.laurent / table.front().residual.optimal, 1.4, 0.05);
  EXPECT_NEAR(table.back().residual.laurent / table.back().residual.optimal, 3.6, 0.05);
}

TEST(PolyharmonicComparison, has_no_jacobi_mask_where_there_is_none) {
  EXPECT_FALSE(compare_sizes(2, std::array{7}).front().residual.jacobi);
  EXPECT_TRUE(compare_sizes(2, std::array{9}).front().residual.jacobi);
}

TEST(PolyharmonicComparison, over_five_rounds_starts_with_the_residuals_of_one) {
  const auto rounds = compare_rounds(1, 17, 5);
  const auto one = compare_sizes(1, std::array{17}).front().residual;
  ASSERT_EQ(rounds.size(), 5);
  EXPECT_DOUBLE_EQ(rounds[0].residual.laurent, one.laurent);
  EXPECT_DOUBLE_EQ(rounds[0].residual.jacobi.value(), one.jacobi.value());
  EXPECT_DOUBLE_EQ(rounds[0].residual.least_squares, one.least_squares);
  EXPECT_NEAR(rounds[4].residual.optimal, 0.010828, 0.51e-6);
}

TEST(LimitError, of_the_exact_mask_falls_with_its_size) {
  // coefficients fall like r^-4: what is cut off beyond N falls like N^-2, in the cosets' sums and with them in limits
  for (int m : {1, 2}) {
    const LimitErrorOptions options{.levels = 10, .sample_level = 2};
    const double small = limit_error(truncated_laurent_mask(m, 17), m, options);
    const double large = limit_error(truncated_laurent_mask(m, 33), m, options);
    EXPECT_LT(large, 0.4 * small) << m;
    EXPECT_LT(large, 0.01) << m;
  }
}

TEST(LimitError, with_precision_does_not_grow_with_the_levels) {
  const auto s = to_double(optimal_mask(2, 17, {.precision = 3}).mask);
  const double early = limit_error(s, 2, {.levels = 10}), late = limit_error(s, 2, {.levels = 16});
  EXPECT_NEAR(early, late, 0.01 * late);
  EXPECT_LT(late, 0.01);
}

TEST(LimitError, compares_all_rounds_at_every_sample_level) {
  // the points of a coarser level are among those of a finer one
  const auto s = to_double(optimal_mask(2, 9, {.precision = 3}).mask);
  double before = 0;
  for (int level = 0; level <= 3; ++level) {
    const double error = limit_error(s, 2, {.levels = 8, .sample_level = level});
    EXPECT_GE(error, before * (1 - 1e-12));
    before = error;
  }
}

TEST(LimitError, refuses_sample_levels_beyond_the_levels) {
  EXPECT_THAT([] { limit_error(truncated_laurent_mask(1, 5), 1, {.levels = 2, .sample_level = 3}); },
              ThrowsMessage<InvalidInput>(HasSubstr("found 3 and 2")));
}

TEST(CompareLimits, follows_the_masks) {
  const auto all = compare_limits(2, 9, {.precision = 3});
  EXPECT_DOUBLE_EQ(all.jacobi.value(), limit_error(to_double(jacobi_mask(2, {.rounds = 1})), 2));
  EXPECT_DOUBLE_EQ(all.optimal, limit_error(to_double(optimal_mask(2, 9, {.precision = 3}).mask), 2));
}

}  // namespace
}  // namespace batten
