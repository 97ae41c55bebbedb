// SPDX-License-Identifier: MIT
#include <batten/tests/app/command_run.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace batten::test {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

Outcome subdivide(const Folder& folder, const std::string& arguments) {
  return run_batten(folder, words("subdivide " + arguments));
}

std::vector<double> values_of(const Folder& folder, const std::string& arguments) {
  const Outcome outcome = subdivide(folder, arguments + " -o out.csv --quiet");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  return column(folder, "out.csv", "value");
}

void expect_failure(const Folder& folder, const std::string& arguments, int status, const std::string& message) {
  const auto before = folder.names();
  const Outcome outcome = subdivide(folder, arguments);
  expect_refusal(outcome, status, message);
  EXPECT_THAT(outcome.err, testing::StartsWith("batten subdivide: "));
  EXPECT_EQ(folder.names(), before);
}

constexpr const char* plate = "examples/data/plate.csv";

TEST(SubdivideCommand, makes_the_plate_of_the_book) {  // [Warren & Weimer 2001, sec. 5.2], 8 x 8, a block of ones
  const Folder folder;
  std::string arguments = plate;
  arguments += " --scheme polyharmonic --order 2 --precision 3";
  const auto smooth = values_of(folder, arguments);
  ASSERT_THAT(smooth, SizeIs(57 * 57));
  EXPECT_NEAR(smooth[28 + 57 * 28], 1, 0.03);
  EXPECT_NEAR(smooth[0], 0, 0.03);
  EXPECT_LT(*std::max_element(smooth.begin(), smooth.end()), 1.05);
  // a harmonic one has a spike at the corners of the block
  const auto harmonic = values_of(folder, std::string(plate) + " --scheme polyharmonic --order 1");
  EXPECT_GT(harmonic[16 + 57 * 16], 1.3);
  for (int k = 0; k < 57; ++k) {  // mirrored and turned data, so the result
    EXPECT_NEAR(harmonic[static_cast<std::size_t>(k)], harmonic[static_cast<std::size_t>(56 - k)], 1e-14);
    EXPECT_NEAR(harmonic[static_cast<std::size_t>(k)], harmonic[static_cast<std::size_t>(57 * k)], 1e-14);
  }
}

TEST(SubdivideCommand, uses_schemes_of_the_line_in_both_directions) {
  const Folder folder;
  folder.write("grid.csv", "0 1 2 3\n10 11 12 13\n20 21 22 23\n");  // linear: i + 10 j
  const auto value = values_of(folder, "grid.csv --scheme bspline --order 2 --levels 1");
  const auto x = column(folder, "out.csv", "x"), y = column(folder, "out.csv", "y");
  ASSERT_THAT(value, SizeIs(7 * 5));
  for (std::size_t k = 0; k < value.size(); ++k) EXPECT_DOUBLE_EQ(value[k], x[k] + 10 * y[k]);
  const auto cubic = values_of(folder, "grid.csv --scheme bspline --order 4 --levels 1 --boundary open");
  const auto u = column(folder, "out.csv", "x"), v = column(folder, "out.csv", "y");
  for (std::size_t k = 0; k < cubic.size(); ++k) EXPECT_NEAR(cubic[k], u[k] + 10 * v[k], 1e-13);
}

TEST(SubdivideCommand, ends_the_grid_as_asked) {
  const Folder folder;
  folder.write("grid.csv", "1,2,3,4\n5,6,7,8\n1,2,3,4\n");
  EXPECT_THAT(values_of(folder, "grid.csv --scheme bspline --order 4 --levels 2 --boundary reflect"), SizeIs(13 * 9));
  EXPECT_THAT(values_of(folder, "grid.csv --scheme bspline --order 4 --levels 2 --boundary periodic"), SizeIs(16 * 12));
  EXPECT_THAT(values_of(folder, "grid.csv --scheme bspline --order 4 --levels 1 --boundary zero"), SizeIs(11 * 9));
  EXPECT_THAT(values_of(folder, "grid.csv --scheme bspline --order 4 --levels 0"), SizeIs(12));
  // dual: no new point lies where an old one was, so the default is open
  EXPECT_THAT(values_of(folder, "grid.csv --scheme bspline --order 3 --levels 1"), SizeIs(6 * 4));
}

TEST(SubdivideCommand, writes_what_paraview_opens_and_a_picture) {
  if (!has_vtk) GTEST_SKIP() << "built without VTK";
  const Folder folder;
  const Outcome outcome =
      subdivide(folder, std::string(plate) + " --scheme butterfly --levels 2 -o g.vti --picture g.png --view map");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("8 x 8 values ->"));
  EXPECT_EQ(folder.read("g.png").substr(1, 3), "PNG");
  EXPECT_THAT(folder.read("g.vti"), HasSubstr("subdivided grid"));
}

TEST(SubdivideCommand, says_what_cannot_be) {
  const Folder folder;
  folder.write("grid.csv", "1,2,3\n4,5,6\n");
  folder.write("ragged.csv", "1,2,3\n4,5\n");
  folder.write("text.csv", "1,2,3\n4,five,6\n");
  folder.write("empty.csv", "");
  const std::string bspline = " --scheme bspline --order 4 ";
  expect_failure(folder, "none.csv -o a.csv" + bspline, 1, "none.csv");
  expect_failure(folder, "ragged.csv -o a.csv" + bspline, 1, "line 2: the first row has 3 numbers, this one has 2");
  expect_failure(folder, "text.csv -o a.csv" + bspline, 1, "line 2, column 2: 'five' is not a number");
  expect_failure(folder, "empty.csv -o a.csv" + bspline, 1, "a matrix of numbers is expected, the file is empty");
  expect_failure(folder, "grid.csv -o grid.csv" + bspline, 2, "is an input and would be overwritten");
  expect_failure(folder, "grid.csv -o a.obj" + bspline, 2, "the name must end with .vti or .csv, found 'a.obj'");
  expect_failure(folder, "grid.csv -o a.csv --scheme spline", 2,
                 "--scheme: there is no scheme 'spline'; did you mean 'bspline'? The schemes are");
  expect_failure(folder, "grid.csv -o a.csv --scheme slow-flwo", 2, "did you mean 'slow-flow'?");
  expect_failure(folder, "grid.csv -o a.csv --scheme polyharmonic --order 1 --method exact", 1,
                 "of the mask must sum to 1, found");
  expect_failure(folder, "grid.csv -o a.csv --scheme custom --mask 1/2,1,1/4,1/4", 1, "coset");
  expect_failure(folder, "grid.csv -o a.csv --boundary reflect --scheme bspline --order 3", 1,
                 "symmetric about 0 in x");
  expect_failure(folder, "grid.csv -o a.csv --boundary open" + bspline, 1, "too few in y");
  expect_failure(folder, "grid.csv -o a.csv --scheme tension --sigma 0", 2, "changes from level to level");
}

}  // namespace
}  // namespace batten::test
