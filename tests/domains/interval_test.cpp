// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/interval.h>
#include <batten/domains/rectangle.h>

#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

TEST(Interval, coarser_levels_keep_every_second_breakpoint_and_lengthen_the_last_cell) {
  const Interval coarse = Interval(0, 1, 11).coarser();
  EXPECT_EQ(std::vector<int>(coarse.breakpoints().begin(), coarse.breakpoints().end()),
            (std::vector<int>{0, 2, 4, 6, 8, 11}));
  const Interval coarser = coarse.coarser();
  EXPECT_EQ(std::vector<int>(coarser.breakpoints().begin(), coarser.breakpoints().end()), (std::vector<int>{0, 4, 11}));
}

TEST(Interval, last_cell_is_less_than_twice_the_others_on_every_level) {
  for (int cells = 2; cells < 300; ++cells)
    for (Interval i(0, 1, cells); i.cells() > 1; i = i.coarser()) {
      const auto b = i.breakpoints();
      EXPECT_LT(b[b.size() - 1] - b[b.size() - 2], 2 * i.regular_cell());
      EXPECT_GE(b[b.size() - 1] - b[b.size() - 2], i.regular_cell());
    }
}

TEST(Interval, finds_the_cell_of_a_position_with_the_ends_in_the_end_cells) {
  const Interval i = Interval(0, 1, 11).coarser();
  EXPECT_EQ(i.cell_of(0), 0);
  EXPECT_EQ(i.cell_of(1.99), 0);
  EXPECT_EQ(i.cell_of(2), 1);
  EXPECT_EQ(i.cell_of(10.5), 4);
  EXPECT_EQ(i.cell_of(11), 4);
}

TEST(Interval, coordinates_of_the_ends_are_exact) {
  const Interval i(0.1, 0.7, 7);
  EXPECT_EQ(i.coordinate(0), 0.1);
  EXPECT_EQ(i.coordinate(7), 0.7);
  EXPECT_EQ(i.to_cells(0.7), 7);
}

TEST(Interval, refuses_empty_and_endless_ones) {
  EXPECT_THROW(Interval(1, 1, 4), InvalidInput);
  EXPECT_THROW(Interval(0, INFINITY, 4), InvalidInput);
  EXPECT_THROW(Interval(0, 1, 0), InvalidInput);
  EXPECT_THROW(Interval(0, 1, 1).coarser(), InvalidInput);
}

TEST(Rectangle, contains_its_border_and_no_nan) {
  const Rectangle r{Interval(0, 1, 2), Interval(0, 2, 2)};
  EXPECT_TRUE(r.contains(0, 2));
  EXPECT_FALSE(r.contains(0, 2.01));
  EXPECT_FALSE(r.contains(std::nan(""), 1));
}

}  // namespace
}  // namespace batten
