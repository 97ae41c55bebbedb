// SPDX-License-Identifier: MIT
#include <batten/app/problem_templates.h>
#include <batten/tests/app/command_run.h>
#include <batten/tests/app/solve_problems.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace batten::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

nlohmann::json json_of(const Folder& folder, const std::string& name) {
  return nlohmann::json::parse(folder.read(name));
}

const std::vector<std::string> template_names = {"poisson", "plate", "heat", "vibration", "foundation", "stokes"};

TEST(SolveCommand, prints_templates) {
  const Folder folder;
  for (const std::string& name : template_names) {
    const Outcome run = expect_success(folder, "solve --template " + name);
    EXPECT_EQ(run.out, problem_template(name));
  }
  expect_refusal(run_batten(folder, words("solve --template stoks")), 2,
                 "there is no template 'stoks'; there are poisson, plate, heat, vibration, foundation, stokes");
}

TEST(SolveCommand, refuses_bad_command_lines) {
  const Folder folder;
  folder.write("p.toml", "problem = \"plate\"\n" + square + all_fixed);
  expect_refusal(run_batten(folder, words("solve")), 2, "batten solve: PROBLEM is required");
  expect_refusal(run_batten(folder, words("solve p.toml")), 2, "--output is required");
  expect_refusal(run_batten(folder, words("solve p.toml -o out.vtk")), 2,
                 "-o: the name must end with .vti or .vtu, found 'out.vtk'");
  if (!has_vtk) return;
  expect_refusal(run_batten(folder, words("solve p.toml -o o.vti --picture o.jpg")), 2, "--picture: the name must end");
  expect_refusal(run_batten(folder, words("solve p.toml -o o.vti --report p.toml")), 2, "would be overwritten");
  expect_refusal(run_batten(folder, words("solve q.toml -o o.vti")), 1, "q.toml: there is no such file");
  expect_refusal(run_batten(folder, words("solve p.toml -o no/o.vti")), 1, "the output folder no does not exist");
  EXPECT_THAT(folder.names(), testing::ElementsAre("p.toml"));
}

// What needs the solver and VTK.
class Solving : public testing::Test {
protected:
  void SetUp() override {
    if (!has_vtk) GTEST_SKIP() << "built without VTK";
  }
  Folder folder_;
};

TEST_F(Solving, refuses_bad_files_in_one_line) {
  folder_.write("p.toml", "problem = \"plate\"\ndegre = 3\n" + square + all_fixed);
  expect_refusal(run_batten(folder_, words("solve p.toml -o o.vti")), 1,
                 "batten solve: p.toml:2:1: unknown key 'degre'");
  EXPECT_THAT(folder_.names(), testing::ElementsAre("p.toml"));
}

TEST_F(Solving, a_supported_plate_under_a_sine_is_that_of_the_formula) {
  // D (2 pi²)² w = sin(pi x) sin(pi y)
  folder_.write("p.toml", "problem = \"plate\"\n" + square + "[load]\nq = \"sin(pi*x)*sin(pi*y)\"\n" + all_fixed);
  const Outcome run = expect_success(folder_, "solve p.toml -o o.vti --picture o.png --report o.json --threads 1");
  EXPECT_THAT(lines(run.out), SizeIs(5));
  EXPECT_THAT(run.out,
              AllOf(StartsWith("p.toml: plate, all sides supported\n"), HasSubstr("wrote o.vti o.png o.json")));
  const double pi = std::acos(-1.), top = 1 / (4 * std::pow(pi, 4));
  const auto report = json_of(folder_, "o.json");
  EXPECT_EQ(report["problem"], "plate");
  EXPECT_EQ(report["unknowns"], 17 * 17);
  EXPECT_NEAR(report["extremes"]["value"]["largest"]["value"], top, 1e-4 * top);
  EXPECT_NEAR(report["extremes"]["value"]["largest"]["x"], 0.5, 1e-12);
  EXPECT_NEAR(report["extremes"]["Mx"]["largest"]["value"], top * pi * pi * 1.3, 0.01 * top * pi * pi);
  EXPECT_NEAR(report["compliance"], top / 4, 1e-4 * top);
  EXPECT_NEAR(report["energy"], top / 4, 1e-4 * top);
  EXPECT_LE(report["accuracy"].get<double>(), 1e-10);
  EXPECT_TRUE(report["seconds"].contains("total"));
  // -D (w_xxx + w_xyy) - (1 - nu) w_xyy on the left, outwards: 2 pi³ + 0.7 pi³ times top, inwards on the plate
  EXPECT_NEAR(report["extremes"]["Vn"]["least"]["value"], -top * std::pow(pi, 3) * 2.7, 0.02 * top * std::pow(pi, 3));
  EXPECT_NEAR(report["reactions"]["corners"]["lower_left"], 2 * 0.7 * pi * pi * top, 0.01 * pi * pi * top);
}

TEST_F(Solving, a_ring_of_plates_carries_a_wave_across_its_seam) {
  // (4 pi² + pi²)² w = cos(2 pi x) sin(pi y)
  folder_.write("p.toml", "problem = \"plate\"\n" + square +
                              "[load]\nq = \"cos(2*pi*x)*sin(pi*y)\"\n[sides]\nleft = \"periodic\"\nright = "
                              "\"periodic\"\nbottom = \"simply-supported\"\ntop = \"simply-supported\"\n");
  const Outcome run = expect_success(folder_, "solve p.toml -o o.vti --report o.json");
  EXPECT_THAT(run.out, StartsWith("p.toml: plate, left periodic, right periodic, bottom supported, top supported\n"));
  const double top = 1 / (25 * std::pow(std::acos(-1.), 4));
  const auto report = json_of(folder_, "o.json");
  EXPECT_EQ(report["unknowns"], 16 * 17);
  EXPECT_NEAR(report["extremes"]["value"]["largest"]["value"], top, 1e-3 * top);
  EXPECT_NEAR(report["compliance"], top / 4, 1e-3 * top);
  EXPECT_FALSE(report["reactions"].contains("corners"));
}

TEST_F(Solving, a_clamped_square_has_the_deflection_and_moments_of_the_tables) {
  const std::string clamped =
      "[sides]\nleft = \"clamped\"\nright = \"clamped\"\nbottom = \"clamped\"\ntop = \"clamped\"\n";
  folder_.write("p.toml", "problem = \"plate\"\ndegree = 5\n" + square + "[load]\nq = 1\n" + clamped);
  expect_success(folder_, "solve p.toml -o o.vti --report o.json --quiet");
  const auto report = json_of(folder_, "o.json");
  EXPECT_NEAR(report["extremes"]["value"]["largest"]["value"], 0.00126531908748, 1e-10);
  EXPECT_NEAR(report["extremes"]["Mx"]["least"]["value"], -0.05133376, 1e-6);
  EXPECT_NEAR(report["extremes"]["My"]["largest"]["value"], 0.02290509, 1e-6);
  for (const char* const side : {"left", "right", "bottom", "top"}) EXPECT_NEAR(report["reactions"][side], -0.25, 1e-9);
}

TEST_F(Solving, a_free_plate_must_be_balanced) {
  const std::string free = "[sides]\nleft = \"free\"\nright = \"free\"\nbottom = \"free\"\ntop = \"free\"\n";
  folder_.write("p.toml", "problem = \"plate\"\n" + square + "[load]\nq = 1\n" + free);
  expect_refusal(run_batten(folder_, words("solve p.toml -o o.vti")), 1, "a net force of 1");
  EXPECT_FALSE(folder_.has("o.vti"));
}

TEST_F(Solving, says_when_the_accuracy_is_not_reached) {
  folder_.write("p.toml",
                "problem = \"plate\"\n" + square + "[load]\nq = 1\n" + all_fixed + "[solver]\naccuracy = 1e-18\n");
  const Outcome run = expect_success(folder_, "solve p.toml -o o.vti --report o.json");
  EXPECT_THAT(run.err, AllOf(HasSubstr("batten: note: the accuracy is "), HasSubstr("1e-18 was asked for")));
  EXPECT_THAT(json_of(folder_, "o.json")["notes"], SizeIs(1));
}

TEST_F(Solving, results_can_be_evaluated_for_every_degree) {
  folder_.write("at.csv", "x,y\n0.5,0.5\n0.3,0.8\n");
  for (const int degree : {1, 2, 3, 4, 5}) {
    folder_.write("p.toml", "problem = \"poisson\"\ndegree = " + std::to_string(degree) + '\n' + square +
                                "[load]\nq = \"2*pi^2*sin(pi*x)*sin(pi*y)\"\n" + all_fixed);
    expect_success(folder_, "solve p.toml -o o.vti --quiet");
    expect_success(folder_, "evaluate o.vti --at at.csv --derivatives -o there.csv");
    const auto value = column(folder_, "there.csv", "value");
    const double pi = std::acos(-1.), tolerance = degree == 1 ? 0.02 : 1e-3;
    EXPECT_NEAR(value[0], 1, tolerance) << degree;
    EXPECT_NEAR(value[1], std::sin(0.3 * pi) * std::sin(0.8 * pi), tolerance) << degree;
  }
}

TEST_F(Solving, the_number_of_threads_does_not_change_a_bit) {
  folder_.write("p.toml", "problem = \"plate\"\n" + square +
                              "[material]\nD = \"1 + x^2*y\"\n[load]\nq = \"sin(pi*x)\"\n" + all_fixed);
  expect_success(folder_, "solve p.toml -o a.vti --threads 1 --quiet");
  expect_success(folder_, "solve p.toml -o b.vti --threads 3 --quiet");
  EXPECT_TRUE(folder_.read("a.vti") == folder_.read("b.vti"));
}

TEST_F(Solving, says_nothing_when_quiet) {
  folder_.write("p.toml", "problem = \"plate\"\n" + square + "[load]\nq = 1\n" + all_fixed);
  const Outcome run = expect_success(folder_, "solve p.toml -o o.vti --quiet");
  EXPECT_THAT(run.out, IsEmpty());
  EXPECT_THAT(run.err, IsEmpty());
}

TEST_F(Solving, shows_its_progress_on_a_terminal) {
  folder_.write("p.toml", "problem = \"plate\"\n" + square + "[load]\nq = 1\n" + all_fixed);
  RunOptions options;
  options.on_terminal = true;
  const Outcome run = run_batten(folder_, words("solve p.toml -o o.vti"), options);
  EXPECT_THAT(run.err, HasSubstr("batten solve: read"));
}

TEST_F(Solving, solves_the_templates_of_problems_at_rest) {
  for (const std::string name : {"poisson", "plate", "foundation", "stokes"}) {
    folder_.write("p.toml", problem_template(name));
    expect_success(folder_, "solve p.toml -o " + name + ".vti --quiet");
  }
}

TEST_F(Solving, solves_the_examples_at_rest) {
  for (const std::string name : {"membrane_pegs", "clamped_plate", "lithosphere"})
    expect_success(folder_, "solve examples/data/" + name + ".toml -o " + name + ".vti --quiet");
}

}  // namespace
}  // namespace batten::test
