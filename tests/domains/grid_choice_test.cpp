// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/grid_choice.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace batten {
namespace {

const std::vector<double> x = {0, 10, 3}, y = {2, 4, 7};

TEST(ChooseGrid, widens_the_bounding_box_by_five_percent_of_the_longer_side) {
  const auto r = choose_grid(x, y);
  EXPECT_DOUBLE_EQ(r.x.lower(), -0.5);
  EXPECT_DOUBLE_EQ(r.x.upper(), 10.5);
  EXPECT_DOUBLE_EQ(r.y.lower(), 1.5);
  EXPECT_GE(r.y.upper(), 7.5);
}

TEST(ChooseGrid, default_cells_are_square_and_a_multiple_of_a_power_of_two) {
  const auto r = choose_grid(x, y);
  EXPECT_EQ(r.x.cells(), 256);
  EXPECT_EQ(r.y.cells() % 32, 0);
  EXPECT_NEAR(r.x.length() / r.x.cells(), r.y.length() / r.y.cells(), 1e-12);
}

TEST(ChooseGrid, cells_are_square_in_the_measure_of_the_energy) {
  const auto r = choose_grid(x, y, {.region = {}, .cells = {}, .spacing = {}, .aspect = 4});
  EXPECT_EQ(r.y.cells(), 256);
  EXPECT_NEAR(r.x.length() / r.x.cells(), 4 * r.y.length() / r.y.cells(), 1e-12);
}

TEST(ChooseGrid, honours_cells_with_the_exact_region) {
  const auto r = choose_grid(x, y, {.region = {{0, 1, 2, 5}}, .cells = {{1000, 7}}, .spacing = {}, .aspect = 1});
  EXPECT_EQ(r.x.cells(), 1000);
  EXPECT_EQ(r.y.cells(), 7);
  EXPECT_EQ(r.x.upper(), 1);
  EXPECT_EQ(r.y.upper(), 5);
}

TEST(ChooseGrid, spacing_is_kept_and_the_upper_ends_move_out) {
  const auto r = choose_grid(x, y, {.region = {{0, 10, 0, 3}}, .cells = {}, .spacing = 0.13, .aspect = 1});
  EXPECT_NEAR(r.x.length() / r.x.cells(), 0.13, 1e-13);
  EXPECT_NEAR(r.y.length() / r.y.cells(), 0.13, 1e-13);
  EXPECT_GE(r.x.upper(), 10);
  EXPECT_GE(r.y.upper(), 3);
  EXPECT_EQ(r.x.cells() % 16, 0);  // 77 cells: 16 is the power of two that leaves at most 8
  EXPECT_EQ(r.x.lower(), 0);
}

TEST(ChooseGrid, one_point_gets_a_region_around_it) {
  const std::vector<double> one = {3};
  const auto r = choose_grid(one, one);
  EXPECT_TRUE(r.contains(3, 3));
  EXPECT_GT(r.x.length(), 0);
}

TEST(ChooseGrid, refuses_what_makes_no_grid) {
  const auto choose = [](GridChoice c) { return choose_grid(x, y, c); };
  EXPECT_THROW(choose({.region = {{1, 1, 0, 2}}, .cells = {}, .spacing = {}}), InvalidInput);
  EXPECT_THROW(choose({.region = {{2, 1, 0, 2}}, .cells = {}, .spacing = {}}), InvalidInput);
  EXPECT_THROW(choose({.region = {{0, NAN, 0, 2}}, .cells = {}, .spacing = {}}), InvalidInput);
  EXPECT_THROW(choose({.region = {}, .cells = {{1, 5}}, .spacing = {}}), InvalidInput);
  EXPECT_THROW(choose({.region = {}, .cells = {}, .spacing = 0.}), InvalidInput);
  EXPECT_THROW(choose({.region = {}, .cells = {}, .spacing = 1e-300}), InvalidInput);
  EXPECT_THROW(choose({.region = {}, .cells = {}, .spacing = {}, .aspect = -1}), InvalidInput);
  EXPECT_THROW(choose_grid({}, {}), InvalidInput);
}

}  // namespace
}  // namespace batten
