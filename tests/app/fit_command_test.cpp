// SPDX-License-Identifier: MIT
#include <batten/tests/app/command_run.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace batten::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Le;
using testing::SizeIs;

const std::string topo = "fit examples/data/topo.csv --x x --y y --value z ";

struct Point {
  double x, y;
};

std::vector<Point> scattered_points(int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0, 1);
  std::vector<Point> points(static_cast<std::size_t>(count));
  for (Point& p : points) p = {place(random), place(random)};
  return points;
}

double plane(Point p) { return 1 + 2 * p.x - 3 * p.y; }

// A table of z = f(x, y), its fields separated by `separator`.
template <typename Function>
std::string table_of(const std::vector<Point>& points, Function f, const std::string& separator = ",") {
  std::ostringstream text;
  text.precision(17);
  text << "x" << separator << "y" << separator << "z\n";
  for (const Point& p : points) text << p.x << separator << p.y << separator << f(p) << '\n';
  return text.str();
}

nlohmann::json report_of(const Folder& folder, const std::string& line) {
  expect_success(folder, line + " --report report.json");
  return nlohmann::json::parse(folder.read("report.json"));
}

double largest_error(const Folder& folder, const std::string& file) {
  const auto x = column(folder, file, "x"), y = column(folder, file, "y"), value = column(folder, file, "value");
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    largest = std::max(largest, std::abs(value[i] - plane({x[i], y[i]})));
  }
  return largest;
}

TEST(FitCommand, writes_everything_it_is_asked_for_and_five_lines) {
  if (!has_vtk) GTEST_SKIP() << "built without VTK";
  const Folder folder;
  const Outcome run =
      expect_success(folder, topo + "--cells 32 32 -o t.vti --points-out t.vtp --picture t.png --report t.json");
  EXPECT_THAT(folder.names(), ElementsAre("t.json", "t.png", "t.vti", "t.vtp"));
  EXPECT_THAT(lines(run.out), SizeIs(Le(5U)));
  EXPECT_THAT(run.out, AllOf(HasSubstr("52 points"), HasSubstr("32 x 32 cells"), HasSubstr("lambda"),
                             HasSubstr("residual"), HasSubstr("wrote t.vti t.vtp t.png t.json")));
  EXPECT_THAT(run.err, IsEmpty());
}

TEST(FitCommand, quiet_prints_nothing) {
  const Outcome run = expect_success(Folder(), topo + "--cells 16 16 -o t.csv --quiet");
  EXPECT_THAT(run.out, IsEmpty());
  EXPECT_THAT(run.err, IsEmpty());
}

TEST(FitCommand, map_view_draws_another_picture) {
  if (!has_vtk) GTEST_SKIP() << "built without VTK";
  const Folder folder;
  expect_success(folder, topo + "--cells 16 16 -o t.csv --picture a.png");
  expect_success(folder, topo + "--cells 16 16 -o t.csv --picture b.png --view map");
  EXPECT_NE(folder.read("a.png"), folder.read("b.png"));
}

TEST(FitCommand, reproduces_a_plane_at_the_corners_of_the_cells) {
  const Folder folder;
  folder.write("in.csv", table_of(scattered_points(40), plane));
  for (const char* const how : {"auto", "1", "none"}) {
    expect_success(folder, std::string("fit in.csv --x x --y y --value z --cells 8 6 -o p.csv --smoothing ") + how);
    EXPECT_THAT(column(folder, "p.csv", "value"), SizeIs(9 * 7));
    EXPECT_LT(largest_error(folder, "p.csv"), 1e-9);
  }
}

TEST(FitCommand, reads_standard_input_and_every_separator_and_columns_by_number) {
  const Folder folder;
  const std::vector<Point> points = scattered_points(30);
  const auto wavy = [](Point p) { return std::sin(5 * p.x) * p.y; };
  const std::string options = " --cells 8 8 --smoothing 1e-6 -o ";
  folder.write("in.csv", table_of(points, wavy));
  expect_success(folder, "fit in.csv --x x --y y --value z" + options + "comma.csv");
  const std::string expected = folder.read("comma.csv");

  RunOptions piped;
  piped.input = table_of(points, wavy);
  expect_success(folder, "fit - --x x --y y --value z" + options + "piped.csv", piped);
  EXPECT_EQ(folder.read("piped.csv"), expected);
  expect_success(folder, "fit in.csv --x 1 --y 2 --value 3" + options + "numbers.csv");
  EXPECT_EQ(folder.read("numbers.csv"), expected);
  for (const char* const separator : {";", "\t", "  "}) {
    folder.write("in.csv", table_of(points, wavy, separator));
    expect_success(folder, "fit in.csv --x x --y y --value z" + options + "other.csv");
    EXPECT_EQ(folder.read("other.csv"), expected);
  }
}

TEST(FitCommand, counts_skipped_outside_and_averaged_points) {
  const Folder folder;
  folder.write("in.csv", "x,y,z\n0,0,1\n1,0,2\nnothing,0,0\n0,1,3\n1,1,4\n1,1,6\n5,5,9\n0.5,,1\n");
  const std::string line = "fit in.csv --x x --y y --value z --skip-invalid --smoothing none --cells 8 8 -o t.csv";
  const auto points = report_of(folder, line + " --region -1 2 -1 2")["points"];
  EXPECT_EQ(points, (nlohmann::json{{"used", 5}, {"skipped", 2}, {"outside", 1}, {"merged", 1}}));
  const Outcome run = expect_success(folder, line + " --region -1 2 -1 2");
  EXPECT_THAT(run.out, HasSubstr("5 points, 2 rows skipped, 1 outside the region, 1 averaged"));
  EXPECT_THAT(run.err, AllOf(HasSubstr("batten: note: "), HasSubstr("averaged")));
}

TEST(FitCommand, report_holds_the_numbers_of_the_fit) {
  const Folder folder;
  const auto report =
      report_of(folder, topo + "--cells 12 10 --region -1 7 -1 7 --energy tension --tension 0.5 --degree 2 -o t.csv");
  EXPECT_EQ(report["cells"], nlohmann::json({12, 10}));
  EXPECT_EQ(report["unknowns"], 14 * 12);
  EXPECT_EQ(report["degree"], 2);
  EXPECT_EQ(report["region"], nlohmann::json({-1., 7., -1., 7.}));
  EXPECT_EQ(report["energy_kind"], "tension");
  EXPECT_EQ(report["tension"], 0.5);
  EXPECT_EQ(report["smoothing"], "auto");
  for (const char* const key : {"lambda", "energy", "rms_residual", "effective_degrees", "peak_memory_bytes"}) {
    EXPECT_GT(report.at(key), 0) << key;
  }
  for (const char* const key :
       {"iterations", "search_iterations", "refinement_iterations", "accuracy", "notes", "warnings"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  for (const char* const key : {"read", "write", "total"}) EXPECT_GE(report["seconds"].at(key), 0) << key;
  EXPECT_GE(report["max_residual"]["value"], report["rms_residual"]);
  EXPECT_TRUE(report["max_residual"].contains("x") && report["max_residual"].contains("y"));
}

TEST(FitCommand, report_has_no_effective_degrees_where_they_are_not_computed) {
  EXPECT_TRUE(report_of(Folder(), topo + "--cells 8 8 --smoothing 1e-3 -o t.csv")["effective_degrees"].is_null());
}

TEST(FitCommand, says_that_exact_data_have_no_interior_minimum) {
  const Folder folder;
  // A quadratic is a spline on every grid: the smaller lambda, the better.
  folder.write("in.csv", table_of(scattered_points(500), [](Point p) { return p.x * p.x - p.x * p.y; }));
  const Outcome run = expect_success(folder, "fit in.csv --x x --y y --value z --cells 16 16 -o t.csv");
  EXPECT_THAT(run.err, HasSubstr("batten: note: "));
  EXPECT_THAT(run.err, HasSubstr("no interior minimum"));
  EXPECT_THAT(run.out, HasSubstr("no interior minimum"));
}

TEST(FitCommand, says_that_a_membrane_without_smoothing_depends_on_the_cells) {
  const Folder folder;
  const Outcome run = expect_success(folder, topo + "--cells 16 16 --energy membrane --smoothing none -o t.csv");
  EXPECT_THAT(run.err, AllOf(HasSubstr("batten: note: "), HasSubstr("cell size"), HasSubstr("tension")));
}

TEST(FitCommand, stays_within_the_tolerance_and_writes_an_unreached_one_if_allowed) {
  const Folder folder;
  const auto reached = report_of(folder, topo + "--cells 64 64 --tolerance 5 -o t.csv");
  EXPECT_LE(reached["max_residual"]["value"], 5);
  EXPECT_TRUE(reached["tolerance_reached"]);
  const auto missed = report_of(folder, topo + "--cells 4 4 --tolerance 0.5 --allow -o t.csv");
  EXPECT_GT(missed["max_residual"]["value"], 0.5);
  EXPECT_FALSE(missed["tolerance_reached"]);
  ASSERT_THAT(missed["warnings"], SizeIs(1));
  EXPECT_THAT(missed["warnings"][0].get<std::string>(), HasSubstr("is not reachable on this grid"));
}

TEST(FitCommand, reports_what_constraints_are_worth) {
  const Folder folder;
  const auto reached = report_of(folder, topo + "--cells 32 32 --tolerance 20 -o t.csv");
  EXPECT_NEAR(reached["energy"], 2.58920e6, 2.6e3);  // of a dense solution
  EXPECT_LE(reached["energy_gap"], 1e-3);
  EXPECT_LE(reached["largest_violation"], 1e-9);
  EXPECT_TRUE(reached["least_tolerance"].is_null());
  EXPECT_GT(reached["active"], 10);
  EXPECT_GT(reached["cycles"], 0);
  const auto missed = report_of(folder, topo + "--cells 4 4 --tolerance 0.5 --allow -o t.csv");
  EXPECT_NEAR(missed["least_tolerance"], missed["max_residual"]["value"], 1e-3);
  const auto plane = report_of(folder, topo + "--cells 32 32 --tolerance 100 -o t.csv");
  EXPECT_EQ(plane["energy"], 0);
  EXPECT_TRUE(report_of(folder, topo + "--cells 8 8 -o t.csv")["energy_gap"].is_null());
}

TEST(FitCommand, keeps_the_surface_between_bounds) {
  const Folder folder;
  const auto report = report_of(folder, topo + "--cells 32 32 --smoothing none --minimum 690 --maximum 970 -o t.csv");
  EXPECT_EQ(report["minimum"], 690);
  EXPECT_EQ(report["maximum"], 970);
  EXPECT_LE(report["energy_gap"], 1e-3);
  for (const double v : column(folder, "t.csv", "value")) {
    EXPECT_GE(v, 690);
    EXPECT_LE(v, 970);
  }
}

TEST(FitCommand, a_point_of_weight_zero_has_no_say) {
  const Folder folder;
  folder.write("in.csv", "x,y,z,w\n0,0,1,1\n1,0,3,1\n0,1,-2,2\n1,1,0,1\n0.5,0.5,99,0\n");
  expect_success(folder, "fit in.csv --x x --y y --value z --weight w --smoothing 1 --cells 8 8 -o p.csv");
  EXPECT_LT(largest_error(folder, "p.csv"), 1e-9);
}

TEST(FitCommand, geographic_is_the_aspect_of_the_mid_latitude) {
  const Folder folder;
  folder.write("in.csv", "x,y,z\n10,50,1\n14,52,3\n11,70,-2\n19,58,0\n12,66,4\n");
  const std::string line = "fit in.csv --x x --y y --value z --smoothing 1e-4 --spacing 0.5 -o ";
  expect_success(folder, line + "a.csv --geographic");
  expect_success(folder, line + "b.csv --aspect 2");  // 1 / cos 60 degrees
  const auto a = column(folder, "a.csv", "value"), b = column(folder, "b.csv", "value");
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-8);
}

TEST(FitCommand, spacing_is_the_size_of_the_cells) {
  const Folder folder;
  const auto report = report_of(folder, topo + "--spacing 0.25 --aspect 2 --smoothing 1e-4 -o t.csv");
  const double nx = report["cells"][0], ny = report["cells"][1];
  const std::vector<double> r = report["region"];
  EXPECT_NEAR((r[1] - r[0]) / nx, 0.25, 1e-12);
  EXPECT_NEAR((r[3] - r[2]) / ny, 0.125, 1e-12);
}

TEST(FitCommand, the_standard_error_is_a_column_and_grows_away_from_the_data) {
  const Folder folder;
  expect_success(folder, topo + "--cells 16 16 --region -3 9 -3 9 --standard-error -o t.csv");
  const auto error = column(folder, "t.csv", "standard_error");
  ASSERT_THAT(error, SizeIs(17 * 17));
  for (const double e : error) ASSERT_GT(e, 0);
  EXPECT_GT(error.front(), 2 * error[8 * 17 + 8]);
}

TEST(FitCommand, the_mask_blanks_what_is_farther_than_its_distance_from_every_point) {
  const Folder folder;
  const std::vector<Point> points = scattered_points(12);
  folder.write("in.csv", table_of(points, plane));
  const Outcome run = run_batten(
      folder, words("fit in.csv --x x --y y --value z --cells 16 16 --aspect 2 --mask-distance 0.2 -o p.csv"));
  if (run.status != 0 && run.err.find("has no CGAL") != std::string::npos) GTEST_SKIP() << "built without CGAL";
  ASSERT_EQ(run.status, 0) << run.err;
  const auto x = column(folder, "p.csv", "x"), y = column(folder, "p.csv", "y"),
             value = column(folder, "p.csv", "value");
  std::size_t blank = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    double nearest = HUGE_VAL;
    for (const Point& p : points) nearest = std::min(nearest, std::hypot(x[i] - p.x, 2 * (y[i] - p.y)));
    ASSERT_EQ(std::isnan(value[i]), nearest > 0.2) << x[i] << ' ' << y[i];
    if (std::isnan(value[i])) ++blank;
  }
  EXPECT_GT(blank, 0U);
  EXPECT_LT(blank, x.size());
}

TEST(FitCommand, gives_the_same_bytes_for_every_thread_count) {
  const Folder folder;
  for (const char* const energy : {"thin-plate", "tension"}) {
    const std::string line = topo + "--cells 48 48 --energy " + energy;
    expect_success(folder, line + " --threads 1 -o one.csv");
    expect_success(folder, line + " --threads 2 -o two.csv");
    EXPECT_EQ(folder.read("one.csv"), folder.read("two.csv"));
  }
}

TEST(FitCommand, progress_is_one_line_on_a_terminal_and_is_erased) {
  RunOptions options;
  options.on_terminal = true;
  const Outcome run = expect_success(Folder(), topo + "--cells 32 32 -o t.csv", options);
  EXPECT_THAT(run.err, testing::StartsWith("\r\033[Kbatten fit: read"));
  EXPECT_THAT(run.err, testing::Not(HasSubstr("\n")));
  EXPECT_TRUE(run.err.ends_with("\r\033[K"));
  EXPECT_THAT(expect_success(Folder(), topo + "--cells 32 32 -o t.csv --quiet", options).err, IsEmpty());
}

}  // namespace
}  // namespace batten::test
