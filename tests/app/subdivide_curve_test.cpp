// SPDX-License-Identifier: MIT
#include <batten/tests/app/command_run.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace batten::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

Outcome subdivide(const Folder& folder, const std::string& arguments) {
  return run_batten(folder, words("subdivide " + arguments));
}

void expect_failure(const Folder& folder, const std::string& arguments, int status, const std::string& message) {
  const auto before = folder.names();
  const Outcome outcome = subdivide(folder, arguments);
  expect_refusal(outcome, status, message);
  EXPECT_EQ(folder.names(), before);
}

class SubdivideCurve : public ::testing::Test {
protected:
  std::vector<double> curve(const std::string& arguments, const std::string& name) {
    const Outcome outcome = subdivide(folder_, arguments + " -o out.csv --quiet");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return column(folder_, "out.csv", name);
  }

  Folder folder_;
};

TEST_F(SubdivideCurve, has_the_rules_of_natural_cubics) {  // [Warren & Weimer 2001, sec. 6.2.4]
  folder_.write("p.csv", "x,y\n0,8\n1,0\n2,0\n3,16\n");
  EXPECT_THAT(curve("p.csv --scheme natural-cubic --levels 1", "y"),
              testing::Pointwise(testing::DoubleNear(1e-14), {8, 4, 1, 0, 2, 8, 16}));
  EXPECT_THAT(column(folder_, "out.csv", "parameter"), ElementsAre(0, 0.5, 1, 1.5, 2, 2.5, 3));
}

TEST_F(SubdivideCurve, passes_through_its_points) {
  const auto y = curve("examples/data/hand.csv --scheme natural-cubic --interpolate --limit --levels 2", "y");
  const auto points = std::vector<double>{0, 2, 2.5, 0.5, 0, 1.5, 3.5, 4.5, 4};
  ASSERT_THAT(y, SizeIs(33));
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(y[4 * i], points[i], 1e-13);
}

TEST_F(SubdivideCurve, stays_within_a_tolerance) {
  const std::string within = "examples/data/hand.csv --scheme natural-cubic --tolerance 0.25 --limit --levels 0";
  const auto x = curve(within, "x"), y = column(folder_, "out.csv", "y");
  const auto px = std::vector<double>{0, 1, 2.5, 3, 4.5, 5.5, 5, 3, 1};
  const auto py = std::vector<double>{0, 2, 2.5, 0.5, 0, 1.5, 3.5, 4.5, 4};
  double largest = 0;
  for (std::size_t i = 0; i < px.size(); ++i) largest = std::max(largest, std::hypot(x[i] - px[i], y[i] - py[i]));
  EXPECT_LE(largest, 0.25);
  EXPECT_GT(largest, 0.24);
}

TEST_F(SubdivideCurve, keeps_a_tolerance_of_each_point) {
  folder_.write("p.csv", "t,v,factor\n0,0,1\n1,1,4\n2,0,1\n3,1,0.5\n4,0,2\n");
  const auto v = curve(
      "p.csv --columns v --parameter t --scheme natural-cubic --tolerance 0.1 --tolerance-column factor "
      "--limit --levels 0 --report r.json",
      "v");
  const std::vector<double> points = {0, 1, 0, 1, 0}, factors = {1, 4, 1, 0.5, 2};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(v[i], points[i], 0.1 * factors[i]);
  EXPECT_LT(v[1], 0.65);
  const auto report = nlohmann::json::parse(folder_.read("r.json"));
  EXPECT_LE(report["energy_gap"], 1e-3);
  EXPECT_GT(report["energy"], 0);
  EXPECT_EQ(report["largest_violation"], 0);
  EXPECT_TRUE(report["least_tolerance"].is_null());
  EXPECT_GT(report["active"], 0);
  EXPECT_LE(report["factorisations"], 60);
  EXPECT_NEAR(report["max_residual"]["value"].get<double>(), 1 - v[1], 1e-14);
  EXPECT_EQ(report["max_residual"]["line"], 3);
}

// ∫ p''² with the parameter from 0 to 1 is what --smoothing L multiplies: of 0, 1, 0 at t = 0, 4, 8 second differences
// are -2, ∫ p''² = 3/2 · 4 for unit cells, and cells of 1/2 have 8 times that.
TEST_F(SubdivideCurve, reports_the_energy_of_the_parameter_from_0_to_1) {
  folder_.write("p.csv", "t,v\n0,0\n4,1\n8,0\n");
  curve("p.csv --columns v --parameter t --scheme natural-cubic --interpolate --report r.json", "v");
  const auto report = nlohmann::json::parse(folder_.read("r.json"));
  EXPECT_NEAR(report["energy"].get<double>(), 48, 1e-12);
  EXPECT_TRUE(report["energy_gap"].is_null());
  EXPECT_EQ(report["points_out"], 17);
  curve("examples/data/hand.csv --scheme four-point --report r.json", "y");
  EXPECT_EQ(nlohmann::json::parse(folder_.read("r.json"))["scheme"], "four-point");
}

TEST_F(SubdivideCurve, stays_between_bounds_everywhere) {
  folder_.write("p.csv", "t,v\n0,0\n1,0\n2,0\n3,1\n4,5\n5,5\n6,0\n7,0\n8,0\n9,0\n10,3\n11,0\n");
  for (const std::string way : {"--interpolate", "--smoothing 1e-6", "--tolerance 0.2"}) {
    const auto v = curve(
        "p.csv --columns v --parameter t --scheme natural-cubic --minimum 0 --maximum 5 --limit " + way + " --levels 6",
        "v");
    ASSERT_THAT(v, SizeIs(11 * 64 + 1));
    EXPECT_GE(*std::min_element(v.begin(), v.end()), 0);
    EXPECT_LE(*std::max_element(v.begin(), v.end()), 5);
    EXPECT_NEAR(v[4 * 64], 5, 0.4);  // far from its bound below
  }
}

TEST_F(SubdivideCurve, says_what_bounds_and_tolerances_cannot_be) {
  folder_.write("p.csv", "t,v,e\n0,0,1\n1,7,1\n2,-3,0\n");
  const std::string natural = "p.csv -o a.csv --columns v --parameter t --scheme natural-cubic ";
  expect_failure(folder_, natural + "--interpolate --maximum 6", 1, "line 3: the value 7 is above --maximum 6");
  expect_failure(folder_, natural + "--tolerance 2 --minimum 0", 1,
                 "line 4: the value -3 and all within 2 of it is below --minimum 0");
  expect_failure(folder_, natural + "--tolerance 2 --tolerance-column e", 1,
                 "line 4: a tolerance must be positive, found 0");
  expect_failure(folder_, natural + "--interpolate --minimum 1 --maximum 0", 2, "--minimum must be below --maximum");
  expect_failure(folder_, natural + "--interpolate --tolerance-column e", 2, "--tolerance-column needs --tolerance E");
  expect_failure(folder_, natural + "--minimum 0", 2, "need --interpolate, --smoothing or --tolerance");
  expect_failure(folder_, natural + "--interpolate --minimum -9 --show forces", 2,
                 "--show forces is for curves without");
  expect_failure(folder_, natural + "--interpolate --report a.txt", 2, "--report: the name must end with .json");
  expect_failure(folder_, "p.csv -o a.csv --columns t v --scheme natural-cubic --interpolate --minimum -9", 2,
                 "are for one column of values, found 2");
  expect_failure(folder_, "p.csv -o a.csv --scheme four-point --maximum 1", 2,
                 "--maximum is for --scheme natural-cubic");
  expect_failure(folder_, "p.csv -o a.csv --scheme slow-flow --report r.json", 2, "no options of curves");
}

TEST_F(SubdivideCurve, smooths_towards_the_line_of_regression) {
  folder_.write("p.csv", "t,v\n0,1\n2,2\n3,5\n7,4\n");
  const auto v =
      curve("p.csv --columns v --parameter t --scheme natural-cubic --smoothing 1e6 --limit --levels 0", "v");
  // least squares: slope 11/26, mean 3 at t = 3
  for (const auto& [i, t] : {std::pair{0, 0.}, {1, 2.}, {2, 3.}, {3, 7.}})
    EXPECT_NEAR(v[static_cast<std::size_t>(i)], 3 + 11. / 26 * (t - 3), 1e-5);
}

TEST_F(SubdivideCurve, uses_any_scheme_of_the_line) {
  folder_.write("p.csv", "x,y,z\n1,0,0\n0,1,0\n-1,0,0\n0,-1,0\n");
  const auto x = curve("p.csv --scheme tension --sigma 0 --closed --levels 6", "x");
  const auto y = column(folder_, "out.csv", "y");
  ASSERT_THAT(x, SizeIs(256));
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_NEAR(std::hypot(x[i], y[i]), std::hypot(x[0], y[0]), 1e-3);  // a diamond tends to a circle
  EXPECT_THAT(curve("p.csv --scheme four-point --closed --levels 2", "y"), SizeIs(16));
}

TEST_F(SubdivideCurve, shows_rounds_forces_and_the_multiresolution) {
  if (!has_vtk) GTEST_SKIP() << "built without VTK";
  for (const std::string show : {"result", "rounds", "forces", "multiresolution"}) {
    const Outcome outcome = subdivide(folder_, "examples/data/hand.csv --scheme natural-cubic --levels 3 --show " +
                                                   show + " -o c.vtp --picture c.png");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("energy 18.8333"));
    EXPECT_EQ(folder_.read("c.png").substr(1, 3), "PNG");
  }
}

TEST_F(SubdivideCurve, says_what_cannot_be) {
  folder_.write("p.csv", "x,y,t\n0,8,0\n1,0,1\n2,0,1\n3,16,4\n");
  folder_.write("twice.csv", "x,y\n0,8\n0,8\n3,16\n");
  const std::string natural = "p.csv -o a.csv --scheme natural-cubic ";
  expect_failure(folder_, natural + "--parameter t", 1,
                 "must increase, found 1.000000 in line 3 and 1.000000 in line 4");
  expect_failure(folder_, natural + "--parameter t --closed", 2, "does not tell where the curve closes");
  expect_failure(folder_, natural + "--interpolate --tolerance 1", 2, "exclude each other");
  expect_failure(folder_, natural + "--boundary open", 2, "--boundary is for grids");
  expect_failure(folder_, natural + "--columns x w", 1, "there is no column 'w'");
  expect_failure(folder_, natural + "--show multiresolution --levels 2", 1, "must be a multiple of 2^2");
  expect_failure(folder_, "p.csv -o a.csv --scheme four-point --interpolate", 2,
                 "--interpolate is for --scheme natural");
  expect_failure(folder_, "p.csv -o a.csv --scheme butterfly", 2, "is a scheme of the plane, the input is a curve");
  expect_failure(folder_, "p.csv -o a.vti --scheme natural-cubic", 2, "must end with .vtp or .csv");
  expect_failure(folder_, "twice.csv -o a.csv --scheme natural-cubic --parameter chord", 1, "found points 0 and 1");
}

}  // namespace
}  // namespace batten::test
