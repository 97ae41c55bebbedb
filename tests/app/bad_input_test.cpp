// SPDX-License-Identifier: MIT
#include <batten/tests/app/command_run.h>

#include <gmock/gmock.h>

namespace batten::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::string topo = "fit examples/data/topo.csv --x x --y y --value z -o out.csv ";

// The run fails with one line that opens with the command and holds `message`, and leaves no output.
void expect_failure(const Folder& folder, const std::string& line, int status, const std::string& message) {
  const std::vector<std::string> before = folder.names();
  const Outcome run = run_batten(folder, words(line));
  EXPECT_EQ(run.status, status) << line;
  EXPECT_THAT(run.err, testing::StartsWith("batten fit: "));
  EXPECT_THAT(run.err, HasSubstr(message));
  EXPECT_THAT(lines(run.err), SizeIs(1)) << run.err;
  EXPECT_THAT(run.out, IsEmpty());
  EXPECT_EQ(folder.names(), before);
}

void expect_failure(const std::string& line, int status, const std::string& message) {
  expect_failure(Folder(), line, status, message);
}

// The same for a table of this text.
void expect_bad_table(const std::string& text, const std::string& options, const std::string& message) {
  const Folder folder;
  folder.write("in.csv", text);
  expect_failure(folder, "fit in.csv --x x --y y --value z --cells 8 8 -o out.csv " + options, 1, message);
}

TEST(BadInput, no_such_file) {
  expect_failure("fit none.csv --x x --y y --value z -o out.csv", 1, "none.csv: there is no such file");
}

TEST(BadInput, empty_file) { expect_bad_table("", "", "in.csv: the file is empty"); }

TEST(BadInput, header_only) { expect_bad_table("x,y,z\n", "", "in.csv: there are no rows below the header"); }

TEST(BadInput, missing_column_is_named_with_the_columns_there_are) {
  expect_failure("fit examples/data/topo.csv --x x --y y --value height -o out.csv", 1,
                 "topo.csv: there is no column 'height'; the columns are 'x', 'y', 'z'");
}

TEST(BadInput, a_column_number_beyond_the_last) {
  expect_failure("fit examples/data/topo.csv --x 1 --y 2 --value 4 -o out.csv", 1, "there is no column '4'");
}

TEST(BadInput, a_cell_that_is_no_number_is_named_with_line_column_and_text) {
  expect_bad_table("x,y,z\n0,0,1\n1,abc,2\n0,1,3\n", "", "in.csv: line 3, column 2 ('y'): 'abc' is not a number");
}

TEST(BadInput, a_cell_that_is_not_finite) {
  expect_bad_table("x,y,z\n0,0,1\n1,0,nan\n0,1,3\n", "", "line 3, column 3 ('z'): 'nan' is not finite");
  expect_bad_table("x,y,z\n0,0,1\ninf,0,2\n0,1,3\n", "", "line 3, column 1 ('x'): 'inf' is not finite");
}

TEST(BadInput, no_row_is_left_after_skipping) {
  expect_bad_table("x,y,z\na,0,1\nb,0,2\n", "--skip-invalid", "in.csv: none of the rows (2) can be read");
}

TEST(BadInput, negative_weight_is_named_with_its_line) {
  expect_bad_table("x,y,z,w\n0,0,1,1\n1,0,2,-0.5\n0,1,3,1\n", "--weight w",
                   "in.csv: line 3: weights must not be negative, found -0.5");
}

TEST(BadInput, weights_that_are_all_zero) {
  expect_bad_table("x,y,z,w\n0,0,1,0\n1,0,2,0\n0,1,3,0\n", "--weight w", "expected a weight that is not zero");
}

TEST(BadInput, points_on_a_line_do_not_determine_a_thin_plate) {
  expect_bad_table("x,y,z\n0,0,1\n1,1,2\n2,2,5\n", "", "the thin plate needs three points that are not on one line");
}

TEST(BadInput, coincident_points_further_apart_than_twice_the_tolerance) {
  expect_bad_table("x,y,z\n0,0,1\n1,0,2\n0,0,4\n0,1,3\n", "--tolerance 1",
                   "within their tolerances of each other, found 1");
  expect_bad_table("x,y,z\n0,0,1\n1,0,2\n0,0,4\n0,1,3\n", "--tolerance 1", "and 4 (line 4) at (0, 0)");
}

TEST(BadInput, all_points_outside_the_region) {
  expect_failure(topo + "--cells 8 8 --region 100 200 100 200", 1, "at least one point inside the region, found none");
}

TEST(BadInput, a_region_without_size) {
  expect_failure(topo + "--cells 8 8 --region 1 1 0 2", 1, "region: expected xmin < xmax and ymin < ymax");
  expect_failure(topo + "--cells 8 8 --region 0 2 3 1", 1, "region: expected xmin < xmax and ymin < ymax");
  expect_failure(topo + "--cells 8 8 --region 0 2 0 nan", 2, "--region: 'nan' is not a finite number");
}

TEST(BadInput, fewer_than_two_cells) {
  expect_failure(topo + "--cells 1 8", 2, "--cells: at least 2 x 2 are needed, found 1 x 8");
  expect_failure(topo + "--cells -4 8", 2, "--cells: at least 2 x 2 are needed, found -4 x 8");
}

TEST(BadInput, more_cells_than_memory_has_room_for) {
  expect_failure(topo + "--cells 1000000 1000000", 1,
                 "a fit on 1000000 x 1000000 cells needs about 400 TB of memory, and ");
  expect_failure(topo + "--cells 4000000000 4000000000", 1, "are available; use fewer cells");
  expect_failure(topo + "--spacing 1e-9", 1, "cells needs about ");
  expect_failure(topo + "--spacing 1e-300", 1, "needs about more than 1000 EB of memory");
}

TEST(BadInput, a_spacing_that_is_not_positive) {
  expect_failure(topo + "--spacing 0", 2, "--spacing: '0' is not a positive number");
  expect_failure(topo + "--spacing -1", 2, "--spacing: '-1' is not a positive number");
}

TEST(BadInput, unknown_energy_degree_or_view) {
  expect_failure(topo + "--energy bend", 2, "--energy: bend not in {thin-plate,membrane,tension}");
  expect_failure(topo + "--degree 4", 2, "--degree: 4 not in {2,3}");
  expect_failure(topo + "--picture out.png --view side", 2, "--view: side not in {surface,map}");
}

TEST(BadInput, tension_belongs_to_the_energy_of_that_name_and_lies_between_0_and_1) {
  expect_failure(topo + "--tension 0.5", 2, "--tension belongs to --energy tension, found --energy thin-plate");
  expect_failure(topo + "--energy tension --tension 2", 2, "--tension: '2' is not a number from 0 to 1");
}

TEST(BadInput, smoothing_that_is_no_smoothing) {
  expect_failure(topo + "--smoothing some", 2, "--smoothing: 'some' is neither auto nor none nor a number >= 0");
  expect_failure(topo + "--smoothing -1", 2, "--smoothing: '-1' is neither");
}

TEST(BadInput, options_that_exclude_or_need_each_other) {
  expect_failure(topo + "--smoothing 1 --tolerance 1", 2, "--smoothing excludes --tolerance");
  expect_failure(topo + "--aspect 2 --geographic", 2, "--aspect excludes --geographic");
  expect_failure(topo + "--cells 8 8 --spacing 1", 2, "--cells excludes --spacing");
  expect_failure(topo + "--allow", 2, "--allow requires --tolerance");
  expect_failure(topo + "--view map", 2, "--view requires --picture");
}

TEST(BadInput, a_tolerance_that_is_not_positive) {
  expect_failure(topo + "--tolerance-column z", 2, "--tolerance");
  expect_failure(topo + "--tolerance 0", 2, "--tolerance: '0' is not a positive number");
}

TEST(BadInput, a_tolerance_that_the_grid_cannot_reach_names_the_worst_point) {
  expect_failure(topo + "--cells 4 4 --tolerance 0.5", 1,
                 "the tolerance 0.5 is not reachable on this grid of 4 x 4 cells: the worst point, line ");
  expect_failure(topo + "--cells 4 4 --tolerance 0.5", 1, "and the least that is reachable is 7.75");
}

TEST(BadInput, bounds_that_contradict_each_other_or_the_data) {
  expect_failure(topo + "--minimum 5 --maximum 5", 2, "--minimum must be below --maximum, found 5 and 5");
  expect_failure(topo + "--minimum nan", 2, "--minimum: 'nan' is not a finite number");
  const std::string table = "x,y,z\n0,0,1\n1,0,2\n0,1,-4\n1,1,3\n";
  expect_bad_table(table, "--smoothing none --minimum 0", "minimum 0, found -4 in line 4");
  expect_bad_table(table, "--tolerance 1 --maximum 1.5", "maximum 1.5, found 3 in line 5, farther from it");
}

TEST(BadInput, latitudes_that_are_none) {
  expect_failure("fit examples/data/volcano.csv --x x --y y --value z --geographic -o out.csv", 1,
                 "--geographic: latitudes (--y) must lie between -90 and 90 degrees, found 0 to 600");
}

TEST(BadInput, a_standard_error_without_smoothing) {
  expect_failure(topo + "--cells 8 8 --smoothing none --standard-error", 1, "a standard error needs smoothing");
}

TEST(BadInput, a_mask_that_hides_everything) {
  const Outcome run = run_batten(Folder(), words(topo + "--cells 8 8 --mask-distance 1e-6"));
  if (run.err.find("this build of Batten has no CGAL") != std::string::npos) GTEST_SKIP() << "built without CGAL";
  expect_failure(topo + "--cells 8 8 --mask-distance 1e-6", 1, "--mask-distance: ");
}

TEST(BadInput, thread_counts_and_seeds_that_are_none) {
  expect_failure(topo + "--threads 0", 2, "--threads: Value 0 not in range 1 to 1024");
  expect_failure(topo + "--seed -1", 2, "--seed: '-1' is not a whole number >= 0");
}

}  // namespace
}  // namespace batten::test
