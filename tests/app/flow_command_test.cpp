// SPDX-License-Identifier: MIT
#include <batten/tests/app/command_run.h>
#include <batten/tests/io/vtk_text.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <random>
#include <sstream>

namespace batten::test {
namespace {

using testing::AllOf;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pointwise;
using testing::SizeIs;
using testing::StartsWith;

const std::string in = "flow in.csv --x x --y y --u u --v v ";

// A table of v = (a - 3 t, b + 3 s + 2 t): a rotation of vorticity 6, and, with `divergence`, an expansion along y.
std::string linear_flow(bool divergence) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, 1);
  std::ostringstream text;
  text.precision(17);
  text << "x,y,u,v\n";
  for (int k = 0; k < 40; ++k) {
    const double x = 2 * place(random), y = place(random);
    text << x << ',' << y << ',' << 1 - 3 * y << ',' << -3 + 3 * x + (divergence ? 2 * y : 0) << '\n';
  }
  return text.str();
}

class FlowCommand : public testing::Test {
protected:
  void SetUp() override {
    if (!has_vtk) GTEST_SKIP() << "built without VTK";
    folder_.write("in.csv", linear_flow(false));
  }

  void expect_failure(const std::string& line, int status, const std::string& message) const {
    const std::vector<std::string> before = folder_.names();
    const Outcome run = run_batten(folder_, words(line));
    expect_refusal(run, status, message);
    EXPECT_THAT(run.err, StartsWith("batten flow: "));
    EXPECT_THAT(run.out, IsEmpty());
    EXPECT_EQ(folder_.names(), before);
  }

  nlohmann::json report_of(const std::string& line) const {
    expect_success(folder_, line + " --report report.json");
    return nlohmann::json::parse(folder_.read("report.json"));
  }

  void expect_column(const std::string& name, const std::vector<double>& expected) const {
    const auto found = column(folder_, "there.csv", name);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-7) << name << ' ' << i;
  }

  Folder folder_;
};

TEST_F(FlowCommand, writes_everything_it_is_asked_for_and_five_lines) {
  const Outcome run = expect_success(folder_, in + "--region 0 2 0 1 --cells 16 8 -o f.vti --streamlines 6 "
                                                   "--streamlines-out f.vtp --picture f.png --report f.json");
  EXPECT_THAT(folder_.names(), ElementsAre("f.json", "f.png", "f.vti", "f.vtp", "in.csv"));
  EXPECT_THAT(lines(run.out), SizeIs(5));
  EXPECT_THAT(run.out, AllOf(HasSubstr("40 vectors"), HasSubstr("16 x 8 cells"), HasSubstr("model smooth"),
                             HasSubstr("6 streamlines"), HasSubstr("wrote f.vti f.vtp f.png f.json")));
  for (const char* const name : {"velocity", "divergence", "vorticity", "speed", "stream_function"})
    EXPECT_THAT(folder_.read("f.vti"), HasSubstr("Name=\"" + std::string(name) + "\"")) << name;
  for (const char* const name : {"speed", "time", "length", "vorticity"})
    EXPECT_THAT(folder_.read("f.vtp"), HasSubstr("Name=\"" + std::string(name) + "\"")) << name;
  EXPECT_THAT(folder_.read("f.vti"), HasSubstr("Scalars=\"speed\" Vectors=\"velocity\""));
  EXPECT_THAT(folder_.read("f.vtp"), HasSubstr("NumberOfLines=\"6\""));
}

/// The linear field of least squares is the flow itself where all sides are free.
TEST_F(FlowCommand, writes_the_vectors_with_what_was_fitted) {
  // u of the third one is off by 1; it has no weight. The last one is outside.
  folder_.write("in.csv",
                "x,y,u,v,w\n0,0,1,-3,1\n2,0,1,3,2\n1,0.5,0.5,0,0\n0,1,-2,-3,1\n2,1,-2,3,1\n0.5,0.5,-0.5,-1.5,1\n"
                "3,0,1,6,1\n");
  const Outcome run = expect_success(
      folder_, in + "--weight w --region 0 2 0 1 --cells 16 8 --smoothing 1e-3 -o f.vti --points-out p.vtp");
  EXPECT_THAT(run.out, HasSubstr("wrote f.vti p.vtp"));
  const std::string file = folder_.read("p.vtp");
  EXPECT_EQ(attribute(tag_with(file, "<PointData"), "Vectors"), "velocity");
  EXPECT_THAT(appended_array<double>(file, "Points"),
              ElementsAre(0, 0, 0, 2, 0, 0, 1, 0.5, 0, 0, 1, 0, 2, 1, 0, 0.5, 0.5, 0));
  EXPECT_THAT(appended_array<double>(file, "weight"), ElementsAre(1, 2, 0, 1, 1, 1));
  EXPECT_THAT(appended_array<double>(file, "velocity"),
              ElementsAre(1, -3, 0, 1, 3, 0, 0.5, 0, 0, -2, -3, 0, -2, 3, 0, -0.5, -1.5, 0));
  const std::vector<double> fit = {1, -3, 0, 1, 3, 0, -0.5, 0, 0, -2, -3, 0, -2, 3, 0, -0.5, -1.5, 0};
  std::vector<double> residual(fit.size());
  residual[6] = -1;
  EXPECT_THAT(appended_array<double>(file, "fit"), Pointwise(DoubleNear(1e-9), fit));
  EXPECT_THAT(appended_array<double>(file, "residual"), Pointwise(DoubleNear(1e-9), residual));
}

TEST_F(FlowCommand, checks_the_name_of_the_file_of_vectors) {
  expect_failure(in + "-o f.vti --points-out p.csv", 2, "--points-out: the name must end with .vtp, found 'p.csv'");
  folder_.write("in.vtp", "x,y,u,v\n");
  expect_failure("flow in.vtp --x x --y y --u u --v v -o f.vti --points-out in.vtp", 2,
                 "is an input and would be overwritten");
}

TEST_F(FlowCommand, quiet_prints_nothing) {
  const Outcome run = expect_success(folder_, in + "--smoothing 1 --cells 8 8 -o f.vti --quiet");
  EXPECT_THAT(run.out, IsEmpty());
  EXPECT_THAT(run.err, IsEmpty());
}

TEST_F(FlowCommand, gives_evaluate_velocity_divergence_and_vorticity) {
  folder_.write("at.csv", "x,y\n0,0\n0.5,0.25\n2,1\n");
  for (const char* const model : {"smooth", "slow --smoothing 1e-12", "general"}) {
    const bool is_slow = std::string(model).starts_with("slow");
    const std::string smoothing = is_slow ? "" : " --smoothing 1e-3";
    expect_success(folder_, in + "--region 0 2 0 1 --cells 16 8 -o f.vti --model " + model + smoothing);
    expect_success(folder_, "evaluate f.vti --at at.csv -o there.csv");
    EXPECT_EQ(lines(folder_.read("there.csv"))[0], "x,y,u,v,divergence,vorticity,speed,stream_function");
    if (is_slow) continue;  // has energy: not reproduced
    expect_column("u", {1, 0.25, -2});
    expect_column("v", {-3, -1.5, 3});
    expect_column("divergence", {0, 0, 0});
    expect_column("vorticity", {6, 6, 6});
    expect_column("speed", {std::sqrt(10.), std::hypot(0.25, 1.5), std::sqrt(13.)});
    const auto psi = column(folder_, "there.csv", "stream_function");
    // psi = y - 3/2 y^2 + 3 x - 3/2 x^2 + constant
    EXPECT_NEAR(psi[1] - psi[0], 0.25 - 1.5 * 0.0625 + 1.5 - 1.5 * 0.25, 1e-7);
    EXPECT_NEAR(psi[2] - psi[0], 1 - 1.5 + 6 - 6, 1e-7);
  }
}

TEST_F(FlowCommand, writes_the_same_as_quads) {
  const std::string line = in + "--region 0 2 0 1 --cells 16 8 --smoothing 1e-3 -o ";
  folder_.write("at.csv", "x,y\n0,0\n0.5,0.25\n2,1\n");
  for (const std::string file : {"f.vti", "f.vtu"}) {
    expect_success(folder_, line + file);
    expect_success(folder_, "evaluate " + file + " --at at.csv --derivatives -o " + file + ".csv");
  }
  EXPECT_EQ(folder_.read("f.vti.csv"), folder_.read("f.vtu.csv"));
  const std::string quads = folder_.read("f.vtu");
  EXPECT_THAT(quads, HasSubstr("type=\"UnstructuredGrid\""));
  for (const char* const count : {"NumberOfPoints=\"153\"", "NumberOfCells=\"128\""})
    EXPECT_THAT(quads, HasSubstr(count));
  for (const char* const name : {"velocity", "divergence", "vorticity", "speed", "stream_function"})
    EXPECT_THAT(quads, HasSubstr("Name=\"" + std::string(name) + "\"")) << name;
}

TEST_F(FlowCommand, gives_evaluate_derivatives_and_counts_points_outside) {
  folder_.write("in.csv", linear_flow(true));
  folder_.write("at.csv", "x,y\n0.5,0.25\n3,0\n");
  expect_success(folder_, in + "--region 0 2 0 1 --cells 8 8 -o f.vti --model general --smoothing 1e-3");
  const Outcome run = expect_success(folder_, "evaluate f.vti --at at.csv --derivatives -o there.csv");
  EXPECT_THAT(run.out, HasSubstr("2 points evaluated, 1 outside the region"));
  for (const auto& [name, expected] :
       {std::pair{"u_x", 0.}, {"u_y", -3.}, {"v_x", 3.}, {"v_y", 2.}, {"divergence", 2.}, {"vorticity", 6.}}) {
    const auto found = column(folder_, "there.csv", name);
    EXPECT_NEAR(found[0], expected, 1e-6) << name;
    EXPECT_TRUE(std::isnan(found[1])) << name;
  }
}

TEST_F(FlowCommand, irrotational_has_no_stream_function_and_no_vorticity) {
  folder_.write("at.csv", "x,y\n0.5,0.25\n");
  expect_success(folder_, in + "--cells 8 8 -o f.vti --model irrotational --smoothing 1e-6");
  expect_success(folder_, "evaluate f.vti --at at.csv -o there.csv");
  EXPECT_EQ(lines(folder_.read("there.csv"))[0], "x,y,u,v,divergence,vorticity,speed");
  expect_column("vorticity", {0});
}

TEST_F(FlowCommand, report_holds_the_numbers_of_the_fit) {
  const auto report = report_of(
      "flow examples/data/wind.csv --x x --y y --u u --v v --cells 16 12 --degree 4 "
      "--region -700 0 5000 6600 --smoothing 1e-5 -o f.vti");
  EXPECT_EQ(report["model"], "smooth");
  EXPECT_EQ(report["degree"], 4);
  EXPECT_EQ(report["cells"], nlohmann::json({16, 12}));
  EXPECT_EQ(report["unknowns"], 20 * 16);
  EXPECT_EQ(report["points"]["used"].get<int>() + report["points"]["outside"].get<int>(), 4800);
  EXPECT_GT(report["points"]["outside"], 500);
  EXPECT_EQ(report["lambda"], 1e-5);
  EXPECT_LT(report["largest_divergence"], 1e-6);
  EXPECT_GT(report["max_residual"]["value"], report["rms_residual"]);
  EXPECT_GE(report["max_residual"]["line"], 2);
  EXPECT_LT(report["accuracy"], 1e-6);
  for (const char* const key : {"energy", "iterations", "peak_memory_bytes"}) EXPECT_GT(report.at(key), 0) << key;
  for (const char* const key : {"read", "solve", "write", "total"}) EXPECT_TRUE(report["seconds"].contains(key)) << key;
  EXPECT_TRUE(report["notes"].is_array());
}

TEST_F(FlowCommand, weights_count_and_rows_can_be_skipped) {
  folder_.write("in.csv", "x,y,u,v,w\n0,0,1,0,1\n1,0,1,0,1\nno,0,0,0,1\n0,1,1,0,2\n1,1,1,0,1\n0.5,0.5,99,7,0\n");
  folder_.write("at.csv", "x,y\n0.5,0.5\n");
  const auto report = report_of(in + "--weight w --skip-invalid --smoothing 1 --cells 8 8 -o f.vti");
  EXPECT_EQ(report["points"]["skipped"], 1);
  expect_success(folder_, "evaluate f.vti --at at.csv -o there.csv");
  expect_column("u", {1});
  expect_column("v", {0});
}

TEST_F(FlowCommand, finds_the_flux_between_walls_without_slip) {
  const std::string channel =
      "flow examples/data/channel.csv --x x --y y --u u --v v -o f.vti --cells 48 16 --no-slip bottom,top ";
  const auto report = report_of(channel + "--region 0 3 0 1");
  EXPECT_NEAR(report["flux"], 1, 0.01);
  EXPECT_EQ(report["sides"]["top"], "no-slip");
  EXPECT_EQ(report["sides"]["left"], "free");
  EXPECT_TRUE(report["mean_u"].is_null());
  folder_.write("at.csv", "x,y\n1,0\n2,1\n");
  expect_success(folder_, "evaluate f.vti --at at.csv -o there.csv");
  expect_column("u", {0, 0});
  expect_column("v", {0, 0});
  const auto general = report_of(channel + "--region 0 3 0 1 --model general --smoothing 1e-7");
  EXPECT_NEAR(general["flux"], 1, 0.01);
  EXPECT_EQ(general["sides"]["top"], "no-slip");
  const auto close = report_of(channel + "--region 0 3 0 1 --tolerance 0.2");
  EXPECT_TRUE(close["tolerance_reached"]);
  EXPECT_NEAR(close["flux"], 1, 0.05);
  const auto around = report_of(channel + "--region 0 3 0 1 --periodic x");
  EXPECT_NEAR(around["flux"], 1, 0.01);
  EXPECT_EQ(report_of(channel + "--walls left,right")["flux"], nullptr);
}

TEST_F(FlowCommand, fits_sources_and_eddies_in_a_closed_box) {
  const std::string box = in + "--region 0 2 0 1 --cells 16 8 --model general --smoothing 1e-6 --walls closed ";
  const auto report = report_of(box + "-o f.vti");
  EXPECT_EQ(report["sides"]["left"], "wall");
  EXPECT_EQ(report["flux"], nullptr);
  folder_.write("at.csv", "x,y\n0,0\n2,1\n");
  expect_success(folder_, "evaluate f.vti --at at.csv -o there.csv");
  expect_column("u", {0, 0});
  expect_column("v", {0, 0});
}

TEST_F(FlowCommand, refuses_sides_that_are_unknown_or_named_twice) {
  expect_failure(in + "--walls lft -o f.vti", 2, "--walls: there is no 'lft'; did you mean 'left'?");
  expect_failure(in + "--walls closed --no-slip top -o f.vti", 2, "--no-slip: the side top is wall already");
  expect_failure(in + "--walls left --periodic x -o f.vti", 2, "--periodic: the side left is wall already");
  expect_failure(in + "--no-slip closed --model general -o f.vti", 2, "--model general: expected a free side");
  expect_failure(in + "--no-slip left --model irrotational -o f.vti", 2, "--no-slip belongs to the models");
  expect_failure(in + "--periodic x --cells 6 8 -o f.vti", 1, "7 equal cells between periodic ends");
}

TEST_F(FlowCommand, stays_within_the_tolerance_or_refuses) {
  const std::string wind = "flow examples/data/wind.csv --x x --y y --u u --v v -o f.vti ";
  expect_failure(wind + "--cells 8 8 --tolerance 0.1", 1, "the tolerance 0.1 is not reachable on this grid of 8 x 8");
  const auto report = report_of(wind + "--cells 8 8 --tolerance 0.1 --allow");
  EXPECT_FALSE(report["tolerance_reached"]);
  EXPECT_THAT(report["warnings"], SizeIs(1));
}

TEST_F(FlowCommand, streamlines_pass_through_the_seeds) {
  folder_.write("seeds.csv", "x,y\n0.5,0.5\n1.5,0.25\n0.25,0.75\n");
  const Outcome run = expect_success(
      folder_, in + "--region 0 2 0 1 --cells 8 8 --smoothing 1 -o f.vti --seeds seeds.csv --streamlines-out f.vtp");
  EXPECT_THAT(run.out, HasSubstr("3 streamlines"));
  EXPECT_THAT(folder_.read("f.vtp"), HasSubstr("NumberOfLines=\"3\""));
  folder_.write("seeds.csv", "x,y\n0.5,0.5\n1.5,1.25\n");
  expect_failure(in + "--region 0 2 0 1 --cells 8 8 -o g.vti --seeds seeds.csv --streamlines-out g.vtp", 1,
                 "--seeds: seeds.csv: the seed of line 3 at (1.5, 1.25) lies outside the region (x from 0 to 2, y from "
                 "0 to 1)");
}

TEST_F(FlowCommand, points_of_streamlines_lie_evenly_in_length_or_time) {
  folder_.write("seeds.csv", "x,y\n0.5,0.5\n");
  const std::string line = in + "--region 0 2 0 1 --cells 8 8 --smoothing 1 -o f.vti --seeds seeds.csv ";
  std::vector<std::string> files;
  for (const char* const parameter : {"", "--parameter length ", "--parameter time "}) {
    expect_success(folder_, line + parameter + "--streamlines-out f.vtp");
    files.push_back(folder_.read("f.vtp"));
    for (const char* const name : {"length", "time"})
      EXPECT_THAT(files.back(), HasSubstr("Name=\"" + std::string(name) + "\"")) << name;
  }
  EXPECT_NE(files[0], files[1]);
  EXPECT_NE(files[1], files[2]);
  expect_failure(line + "--parameter speed --streamlines-out g.vtp", 2, "--parameter");
  expect_failure(line + "--parameter time --picture g.png", 2, "--parameter is for the points of --streamlines-out");
}

TEST_F(FlowCommand, pictures_of_arrows_and_of_streamlines_differ) {
  const std::string line = in + "--cells 8 8 --smoothing 1 -o f.vti ";
  expect_success(folder_, line + "--picture a.png");
  expect_success(folder_, line + "--picture b.png --streamlines 5");
  EXPECT_NE(folder_.read("a.png"), folder_.read("b.png"));
  expect_success(folder_, line + "--picture c.png --pixels 300 240");
  EXPECT_EQ(folder_.read("c.png").substr(16, 8), std::string("\0\0\x01\x2c\0\0\0\xf0", 8));  // width and height
  expect_failure(line + "--pixels 300 240", 2, "--pixels");
}

TEST_F(FlowCommand, refuses_what_does_not_fit_together) {
  const std::string out = in + "-o f.vti ";
  expect_failure(out + "--model smoth", 2, "there is no model 'smoth'; did you mean 'smooth'?");
  expect_failure(out + "--ratio 2", 2, "--ratio belongs to --model general, found --model smooth");
  expect_failure(out + "--streamlines-out f.vtp", 2, "--streamlines-out: say which streamlines");
  expect_failure(out + "--streamlines 5", 2, "--streamlines: say what for");
  expect_failure(out + "--streamlines 0 --picture f.png", 2, "--streamlines");
  expect_failure(out + "--streamlines 5 --seeds in.csv --picture f.png", 2, "--seeds");
  expect_failure(out + "--degree 2", 2, "--degree");
  expect_failure(out + "--cells 1 8", 2, "--cells: at least 2 x 2 are needed");
  expect_failure(out + "--smoothing much", 2, "--smoothing: 'much' is neither auto nor none");
  expect_failure(in + "-o f.csv", 2, "-o: the name must end with .vti or .vtu, found 'f.csv'");
  expect_failure(out + "--streamlines 5 --streamlines-out f.vtu", 2,
                 "--streamlines-out: the name must end with .vtp, found 'f.vtu'");
  expect_failure(out + "--picture f.jpg", 2, "--picture: the name must end with .png, found 'f.jpg'");
  expect_failure(out + "--report f.txt", 2, "--report: the name must end with .json, found 'f.txt'");
  expect_failure(in + "-o f.vti --report in.csv", 2, "in.csv: is an input");
  for (const char* const unknown : {"--shores closed", "--aspect 2"})
    expect_failure(out + unknown, 2, words(unknown)[0]);
}

TEST_F(FlowCommand, refuses_tables_that_do_not_determine_a_flow) {
  const std::string out = in + "--cells 8 8 --smoothing 1 -o f.vti ";
  expect_failure("flow in.csv --x x --y y --u u --v w -o f.vti", 1,
                 "in.csv: there is no column 'w'; the columns are 'x', 'y', 'u', 'v'");
  folder_.write("in.csv", "x,y,u,v\n0,0,1,0\n1,1,0,1\n");
  expect_failure(out, 1, "the model smooth needs three points that are not on one line");
  folder_.write("in.csv", "x,y,u,v\n0,0,1,0\n1,1,0,fast\n1,2,3,4\n");
  expect_failure(out, 1, "in.csv: line 3, column 4 ('v'): 'fast' is not a number");
  folder_.write("in.csv", "x,y,u,v,w\n0,0,1,0,1\n1,1,0,1,-2\n1,2,3,4,1\n");
  expect_failure(out + "--weight w", 1, "in.csv: line 3: weights must not be negative, found -2");
  expect_failure(out + "--region 5 6 5 6", 1, "found none of 3");
  expect_failure("flow none.csv --x x --y y --u u --v v -o f.vti", 1, "none.csv: there is no such file");
}

}  // namespace
}  // namespace batten::test
