// SPDX-License-Identifier: MIT
#include <batten/io/picture_field.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace batten {
namespace {

using ::testing::ElementsAre;

std::vector<int> triangles_of(std::vector<double> values) {
  const GridSamples grid{.points = {2, 2}, .arrays = {{"value", 1, std::move(values)}}};
  return scene_mesh(picture_field(grid, "value", 2), {}).triangles;
}

TEST(SceneMesh, cuts_cells_between_the_corners_that_differ_less) {
  EXPECT_THAT(triangles_of({0, 1, 1, 0.2}), ElementsAre(0, 1, 2, 1, 3, 2));
  EXPECT_THAT(triangles_of({1, 0, 0.2, 1}), ElementsAre(0, 1, 3, 0, 3, 2));  // its mirror image
}

}  // namespace
}  // namespace batten
