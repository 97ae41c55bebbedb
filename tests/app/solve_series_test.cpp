// SPDX-License-Identifier: MIT
#include <batten/app/problem_templates.h>
#include <batten/app/solve_outputs.h>
#include <batten/fem/vibration.h>
#include <batten/tests/app/command_run.h>
#include <batten/tests/app/solve_problems.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace batten::test {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

nlohmann::json json_of(const Folder& folder, const std::string& name) {
  return nlohmann::json::parse(folder.read(name));
}

class SolveSeries : public testing::Test {
protected:
  void SetUp() override {
    if (!has_vtk) GTEST_SKIP() << "built without VTK";
  }
  Folder folder_;
};

TEST_F(SolveSeries, writes_modes_with_pictures_and_a_collection) {
  folder_.write("p.toml", "problem = \"poisson\"\n" + square + all_fixed + "[modes]\ncount = 3\n");
  const Outcome run = expect_success(folder_, "solve p.toml -o o.vti --picture o.png --report o.json");
  for (const char* const name : {"o_mode1.vti", "o_mode3.vti", "o_mode1.png", "o_mode3.png", "o.pvd", "o.json"})
    EXPECT_TRUE(folder_.has(name)) << name;
  EXPECT_FALSE(folder_.has("o.vti"));
  EXPECT_THAT(run.out, HasSubstr("mode      frequency"));
  EXPECT_THAT(folder_.read("o.pvd"), HasSubstr("timestep=\"3\" file=\"o_mode3.vti\""));
  const auto report = json_of(folder_, "o.json");
  ASSERT_THAT(report["modes"], SizeIs(3));
  const double pi = std::acos(-1.);
  EXPECT_NEAR(report["modes"][0]["eigenvalue"], 2 * pi * pi, 1e-3);
  EXPECT_NEAR(report["modes"][0]["frequency"], std::sqrt(2.) / 2, 1e-4);
  EXPECT_NEAR(report["modes"][1]["angular_frequency"], std::sqrt(5.) * pi, 1e-3);
}

// w = 2 sin πx sin πy on the simply supported unit square with D = 1, ν = 0.3 and density 1: Mx = 1.3 π² w, and Vn on
// the middle of the left side -(w_xxx + 1.7 w_xyy) = 2.7 π³ 2 but for its sign.
TEST(SolveOutputs, sample_the_moments_of_modes_too) {
  const Side side = Side::simply_supported();
  BoundaryProblem problem{
      KirchhoffPlate{}, {Interval(0, 1, 32), Interval(0, 1, 32)}, 3, {side, side, side, side}, {}, {}};
  const Mode mode = vibration_modes(problem, 1, Field(1.)).front();
  const GridSamples grid = samples_of(mode.shape, problem);
  const auto values = [&](const std::string& name) {
    const auto array =
        std::find_if(grid.arrays.begin(), grid.arrays.end(), [&](const auto& a) { return a.name == name; });
    return array == grid.arrays.end() ? std::vector<double>(33 * 33) : array->values;
  };
  constexpr std::size_t centre = 16 * 33 + 16;
  const double pi = std::acos(-1.);
  EXPECT_NEAR(std::abs(values("value")[centre]), 2, 1e-5);
  EXPECT_NEAR(values("Mx")[centre] / values("value")[centre], 1.3 * pi * pi, 0.02);
  EXPECT_NEAR(std::abs(values("Vn")[16 * 33]), 2 * 2.7 * std::pow(pi, 3), 1);
}

TEST_F(SolveSeries, writes_motion_as_a_collection) {
  folder_.write("p.toml", "problem = \"poisson\"\n" + square + all_fixed +
                              "[time]\nend = 0.1\nstep = 0.01\ninitial = \"sin(pi*x)*sin(pi*y)\"\n");
  expect_success(folder_, "solve p.toml -o o.vti --picture o.png --report o.json");
  EXPECT_TRUE(folder_.has("o_0000.vti") && folder_.has("o_0010.vti") && folder_.has("o.png"));
  EXPECT_FALSE(folder_.has("o_0011.vti"));
  EXPECT_THAT(folder_.read("o.pvd"), HasSubstr("file=\"o_0010.vti\""));
  const auto frames = json_of(folder_, "o.json")["frames"];
  ASSERT_THAT(frames, SizeIs(11));
  EXPECT_NEAR(frames[0]["largest"]["value"], 1, 1e-3);
  const double pi = std::acos(-1.);
  EXPECT_NEAR(frames[10]["largest"]["value"], std::exp(-0.2 * pi * pi), 0.02);
  expect_success(folder_, "solve p.toml -o o.vti --quiet");
}

TEST_F(SolveSeries, solves_the_templates_of_modes_and_motion) {
  for (const std::string name : {"heat", "vibration"}) {
    folder_.write("p.toml", problem_template(name));
    expect_success(folder_, "solve p.toml -o " + name + ".vti --quiet");
  }
}

TEST_F(SolveSeries, solves_the_examples_of_modes_and_motion) {
  for (const std::string name : {"chladni", "heat_checkerboard"})
    expect_success(folder_, "solve examples/data/" + name + ".toml -o " + name + ".vti --quiet");
}

}  // namespace
}  // namespace batten::test
