// SPDX-License-Identifier: MIT
#ifdef BATTEN_WITH_VTK
#include <batten/domains/errors.h>
#include <batten/io/point_file.h>
#include <batten/tests/io/temporary_folder.h>
#include <batten/tests/io/vtk_text.h>
#include <batten/tests/support/message_of.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

ScatteredSamples sample_points() {
  ScatteredSamples samples;
  samples.x = {0.1, 1e6 + 0.1, -3};
  samples.y = {1, 2, 3};
  samples.z = {0, -0.5, 1e-300};
  samples.arrays = {
      {"direction", 3, {1, 2, 3, 4, 5, 6, 7, 8, 9}}, {"value", 1, {5, 6, 7}}, {"residual", 1, {0.1, 0, -0.1}}};
  return samples;
}

TEST(PointFile, has_points_vertices_and_arrays_exactly) {
  const TemporaryFolder folder;
  const ScatteredSamples samples = sample_points();
  write_points(folder / "a.vtp", samples);
  const std::string file = bytes_of(folder / "a.vtp");
  const std::string piece = tag_with(file, "<Piece");
  EXPECT_EQ(attribute(piece, "NumberOfPoints"), "3");
  EXPECT_EQ(attribute(piece, "NumberOfVerts"), "3");
  EXPECT_EQ(attribute(tag_with(file, "<PointData"), "Scalars"), "value");
  EXPECT_EQ(attribute(tag_with(file, "<PointData"), "Vectors"), "direction");
  EXPECT_THAT(appended_array<double>(file, "Points"), ElementsAre(0.1, 1, 0, 1e6 + 0.1, 2, -0.5, -3, 3, 1e-300));
  EXPECT_THAT(appended_array<std::int64_t>(file, "connectivity"), ElementsAre(0, 1, 2));
  EXPECT_THAT(appended_array<std::int64_t>(file, "offsets"), ElementsAre(1, 2, 3));
  for (const PointArray& array : samples.arrays) EXPECT_EQ(appended_array<double>(file, array.name), array.values);
}

TEST(PointFile, refuses_lengths_that_do_not_match) {
  const TemporaryFolder folder;
  ScatteredSamples samples = sample_points();
  samples.arrays[2].values.pop_back();
  EXPECT_EQ(message_of<InvalidInput>([&] { write_points(folder / "a.vtp", samples); }),
            "write_points: array 'residual' must have 3 values, it has 2");
  samples.z.pop_back();
  EXPECT_EQ(message_of<InvalidInput>([&] { write_points(folder / "a.vtp", samples); }),
            "write_points: x, y and z must have equal lengths, found 3, 3 and 2");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(PointFile, refuses_a_target_that_is_no_regular_file) {
  EXPECT_EQ(message_of<IoError>([] { write_points("/dev/null", sample_points()); }),
            "/dev/null: exists and is not a regular file");
}

}  // namespace
}  // namespace batten
#endif
