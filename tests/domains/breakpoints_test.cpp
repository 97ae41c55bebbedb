// SPDX-License-Identifier: MIT
#include <batten/domains/breakpoints.h>
#include <batten/domains/errors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace batten {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Breakpoints, coarser_levels_keep_every_second_one_and_end_with_three_cells_where_odd) {
  const auto uniform = Breakpoints::uniform(-1, 3, 8);
  EXPECT_THAT(uniform.coarser().positions(), ElementsAre(0, 2, 4, 6, 8));
  EXPECT_EQ(uniform.coarser().coordinate(1), 0);
  const Breakpoints odd(std::vector<double>{1, 2, 4, 5, 8, 8.5, 10, 11});
  EXPECT_THAT(odd.coarser().positions(), ElementsAre(0, 3, 7, 10));
  EXPECT_EQ(odd.coarser().coordinate(2), 8);
  for (int cell = 0; cell < 7; ++cell) EXPECT_EQ(odd.parent(cell), std::min(cell / 2, 2));
  EXPECT_EQ(odd.first_child(2), 4);
  EXPECT_EQ(odd.first_child(3), 7);
}

TEST(Breakpoints, of_equal_cells_are_whole_numbers_in_every_unit) {
  EXPECT_THAT(Breakpoints::uniform(0.1, 0.7, 3).positions(), ElementsAre(0, 1, 2, 3));
  EXPECT_TRUE(Breakpoints::uniform(0.1, 0.7, 3).is_uniform());
  EXPECT_FALSE(Breakpoints(std::vector<double>{0, 1, 3}).is_uniform());
  EXPECT_NEAR(Breakpoints::uniform(0.1, 0.7, 3).unit(), 0.2, 1e-16);
}

std::string message(const std::vector<double>& coordinates) {
  try {
    Breakpoints{coordinates};
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(Breakpoints, says_which_coordinate_is_wrong) {
  EXPECT_THAT(message({1}), HasSubstr("at least 2 coordinates, found 1"));
  EXPECT_THAT(message({1, 2, 2}), HasSubstr("found 2.000000 after 2.000000 at index 2"));
  EXPECT_THAT(message({1, std::numeric_limits<double>::quiet_NaN()}), HasSubstr("at index 1"));
  EXPECT_THROW(Breakpoints::uniform(1, 1, 4), InvalidInput);
  EXPECT_THROW(Breakpoints::uniform(0, 1, 0), InvalidInput);
  EXPECT_THROW(Breakpoints::uniform(0, 1, 1).coarser(), InvalidInput);
}

}  // namespace
}  // namespace batten
