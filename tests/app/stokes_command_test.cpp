// SPDX-License-Identifier: MIT
#include <batten/app/problem_templates.h>
#include <batten/tests/app/command_run.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace batten::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

// What needs the solver and VTK.
class SolvingFlows : public testing::Test {
protected:
  void SetUp() override {
    if (!has_vtk) GTEST_SKIP() << "built without VTK";
  }
  nlohmann::json report() const { return nlohmann::json::parse(folder_.read("o.json")); }
  Folder folder_;
};

TEST_F(SolvingFlows, give_the_cavity_of_the_example) {
  const Outcome run = expect_success(
      folder_, "solve examples/data/lid_cavity.toml -o o.vti --picture o.png --report o.json --threads 1");
  EXPECT_THAT(lines(run.out), SizeIs(5));
  EXPECT_THAT(run.out,
              AllOf(StartsWith("examples/data/lid_cavity.toml: slow flow, left a wall, right a wall, bottom a "
                               "wall, top moving\n"),
                    HasSubstr("psi from -0.100076 at (0.5, 0.765027)"), HasSubstr("wrote o.vti o.png o.json")));
  EXPECT_GT(folder_.read("o.png").size(), 50000u);
  const auto json = report();
  EXPECT_EQ(json["problem"], "stokes");
  EXPECT_EQ(json["unknowns"], 128 * 128);  // 132² less two rows at each side
  EXPECT_NEAR(json["psi_min"]["value"], -0.10007626642, 1e-6);
  EXPECT_NEAR(json["psi_min"]["x"], 0.5, 1e-9);
  EXPECT_NEAR(json["psi_min"]["y"], 0.76502654356, 1e-6);
  EXPECT_NEAR(json["psi_max"]["value"], 2.2276e-6, 1e-9);  // the eddies of the lower corners
  EXPECT_NEAR(json["extremes"]["speed"]["largest"]["value"], 1, 0.2);
  EXPECT_LE(json["accuracy"].get<double>(), 1e-10);
  EXPECT_LT(json["largest_divergence"].get<double>(), 1e-6);
  EXPECT_EQ(json["inflow"], 0);
  EXPECT_THAT(json["notes"], SizeIs(0));
  EXPECT_TRUE(json["seconds"].contains("total"));
}

TEST_F(SolvingFlows, are_evaluated_as_other_flows_are) {
  folder_.write(
      "p.toml",
      "problem = \"stokes\"\nx = [0, 2]\ny = [0, 1]\ncells = [16, 8]\n[sides]\nleft = {u = \"4*y*(1-y)\", v = "
      "0}\nright = {u = \"4*y*(1-y)\", v = 0}\nbottom = \"wall\"\ntop = \"wall\"\n");
  folder_.write("at.csv", "x,y\n0.5,0.5\n1.3,0.25\n");
  expect_success(folder_, "solve p.toml -o o.vti --quiet");
  expect_success(folder_, "evaluate o.vti --at at.csv --derivatives -o there.csv");
  const auto values = [&](const char* name) { return column(folder_, "there.csv", name); };
  EXPECT_NEAR(values("u")[0], 1, 1e-10);
  EXPECT_NEAR(values("u")[1], 0.75, 1e-10);
  EXPECT_NEAR(values("v")[1], 0, 1e-10);
  EXPECT_NEAR(values("divergence")[1], 0, 1e-10);
  EXPECT_NEAR(values("vorticity")[1], -2, 1e-9);
  EXPECT_NEAR(values("speed")[1], 0.75, 1e-10);
  EXPECT_NEAR(values("stream_function")[0], 1. / 3, 1e-10);
  EXPECT_NEAR(values("u_y")[1], 2, 1e-9);
}

TEST_F(SolvingFlows, give_the_flow_of_the_template) {
  folder_.write("p.toml", problem_template("stokes"));
  expect_success(folder_, "solve p.toml -o o.vti --report o.json --quiet");
  const auto json = report();
  EXPECT_NEAR(json["inflow"], 2. / 3, 1e-12);
  EXPECT_NEAR(json["net_inflow"], 0, 1e-12);
}

TEST_F(SolvingFlows, write_the_same_as_quads) {
  folder_.write("p.toml", problem_template("stokes"));
  folder_.write("at.csv", "x,y\n0.5,0.5\n0.25,0.75\n");
  for (const std::string file : {"o.vti", "o.vtu"}) {
    expect_success(folder_, "solve p.toml -o " + file + " --quiet");
    expect_success(folder_, "evaluate " + file + " --at at.csv -o " + file + ".csv --quiet");
  }
  EXPECT_EQ(folder_.read("o.vti.csv"), folder_.read("o.vtu.csv"));
  EXPECT_THAT(folder_.read("o.vtu"), testing::HasSubstr("type=\"UnstructuredGrid\""));
}

TEST_F(SolvingFlows, are_refused_in_one_line_where_more_flows_in_than_out) {
  folder_.write("p.toml",
                "problem = \"stokes\"\nx = [0, 2]\ny = [0, 1]\ncells = [16, 8]\n[sides]\nleft = {u = 0.1, v = "
                "0}\nright = \"wall\"\nbottom = \"wall\"\ntop = \"wall\"\n");
  expect_refusal(run_batten(folder_, words("solve p.toml -o o.vti")), 1, "a net inflow of 0.1 (in 0.1, out 0)");
  EXPECT_FALSE(folder_.has("o.vti"));
}

TEST_F(SolvingFlows, do_not_depend_on_the_number_of_threads) {
  folder_.write("p.toml", problem_template("stokes"));
  expect_success(folder_, "solve p.toml -o a.vti --threads 1 --quiet");
  expect_success(folder_, "solve p.toml -o b.vti --threads 3 --quiet");
  EXPECT_TRUE(folder_.read("a.vti") == folder_.read("b.vti"));
}

}  // namespace
}  // namespace batten::test
