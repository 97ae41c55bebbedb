// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/nearest_point.h>
#include <batten/tests/support/message_of.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace batten {
namespace {

// Built without CGAL, the class says so; there is nothing else to test then.
bool is_available() {
  try {
    NearestPoint(std::vector{0.}, std::vector{0.});
  } catch (const InvalidInput&) {
    return false;
  }
  return true;
}

class NearestPointTest : public testing::Test {
protected:
  void SetUp() override {
    if (!is_available()) GTEST_SKIP() << "built without CGAL";
  }
};

TEST(BuildWithoutCgal, says_what_it_cannot_do) {
  if (is_available()) GTEST_SKIP() << "built with CGAL";
  EXPECT_EQ(message_of<InvalidInput>([] { NearestPoint(std::vector{0.}, std::vector{0.}); }),
            "this build of Batten has no CGAL: distances to the nearest point are not available");
}

double distance_by_search(const std::vector<double>& px, const std::vector<double>& py, double x, double y) {
  double least = std::hypot(x - px[0], y - py[0]);
  for (std::size_t i = 1; i < px.size(); ++i) least = std::min(least, std::hypot(x - px[i], y - py[i]));
  return least;
}

// At places inside and far outside, in an order that jumps.
void expect_distances_of_search(const std::vector<double>& px, const std::vector<double>& py) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-2, 3);
  NearestPoint points(px, py);
  for (int k = 0; k < 500; ++k) {
    const double x = place(random), y = place(random);
    ASSERT_DOUBLE_EQ(points.distance(x, y), distance_by_search(px, py, x, y));
  }
}

TEST_F(NearestPointTest, agrees_with_a_search_of_all_points) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, 1);
  std::vector<double> x(300), y(300);
  for (double& v : x) v = place(random);
  for (double& v : y) v = place(random);
  expect_distances_of_search(x, y);
}

TEST_F(NearestPointTest, agrees_with_a_search_on_a_grid_of_points_with_many_ties) {
  std::vector<double> x, y;
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i < 12; ++i) x.push_back(i / 11.), y.push_back(j / 11.);
  expect_distances_of_search(x, y);
}

TEST_F(NearestPointTest, one_point_two_points_points_on_a_line_and_coincident_points_are_enough) {
  expect_distances_of_search({0.3}, {0.7});
  expect_distances_of_search({0.3, 0.4}, {0.7, -0.2});
  expect_distances_of_search({0, 0.5, 0.25, 1}, {1, 2, 1.5, 3});
  expect_distances_of_search({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5});
}

TEST_F(NearestPointTest, is_zero_at_a_point) {
  NearestPoint points(std::vector{0.1, 0.9, 0.4}, std::vector{0.2, 0.3, 0.8});
  EXPECT_EQ(points.distance(0.9, 0.3), 0);
}

TEST_F(NearestPointTest, refuses_no_points_and_lengths_that_differ) {
  EXPECT_THROW(NearestPoint(std::vector<double>{}, std::vector<double>{}), InvalidInput);
  EXPECT_THROW(NearestPoint(std::vector{1., 2.}, std::vector{1.}), InvalidInput);
}

}  // namespace
}  // namespace batten
