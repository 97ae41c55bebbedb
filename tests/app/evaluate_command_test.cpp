// SPDX-License-Identifier: MIT
#include <batten/tests/app/command_run.h>

#include <gmock/gmock.h>

#include <cmath>

namespace batten::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

void expect_failure(const Folder& folder, const std::string& line, int status, const std::string& message) {
  const std::vector<std::string> before = folder.names();
  const Outcome run = run_batten(folder, words(line));
  EXPECT_EQ(run.status, status) << line;
  EXPECT_THAT(run.err, testing::StartsWith("batten evaluate: "));
  EXPECT_THAT(run.err, HasSubstr(message));
  EXPECT_THAT(lines(run.err), SizeIs(1)) << run.err;
  EXPECT_EQ(folder.names(), before);
}

// A folder with a result to evaluate, on x from 0 to 2 and y from 0 to 1.
class EvaluateCommand : public testing::Test {
protected:
  void SetUp() override {
    if (!has_vtk) GTEST_SKIP() << "built without VTK";
  }

  void fit_plane() const {
    folder_.write("in.csv", "x,y,z\n0,0,1\n1,0,3\n0,1,-2\n1,1,0\n2,1,2\n");  // z = 1 + 2 x - 3 y
    expect_success(folder_, "fit in.csv --x x --y y --value z --region 0 2 0 1 --cells 8 4 -o fit.vti");
  }

  Folder folder_;
};

TEST_F(EvaluateCommand, reproduces_the_fit_at_the_corners_of_its_cells) {
  const std::string fit = "fit examples/data/topo.csv --x x --y y --value z --cells 37 29 -o ";
  expect_success(folder_, fit + "topo.vti");
  expect_success(folder_, fit + "topo.csv");
  const Outcome run = expect_success(folder_, "evaluate topo.vti --at topo.csv -o there.csv");
  EXPECT_THAT(run.out, HasSubstr("1140 points evaluated, 0 outside the region; wrote there.csv"));
  const auto expected = column(folder_, "topo.csv", "value"), found = column(folder_, "there.csv", "value");
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_NEAR(found[i], expected[i], 1e-12 * std::abs(expected[i]));
  }
}

TEST_F(EvaluateCommand, points_that_rounding_puts_beyond_the_end_are_inside) {
  folder_.write("in.csv", "x,y,z\n0.1,0.1,1\n0.7,0.2,3\n0.3,0.7,-2\n");
  expect_success(folder_, "fit in.csv --x x --y y --value z --region 0.1 0.7 0.1 0.7 --cells 8 8 -o fit.vti");
  folder_.write("at.csv", "x,y\n0.70000000000000007,0.70000000000000007\n0.7000000001,0.5\n");
  expect_success(folder_, "evaluate fit.vti --at at.csv -o there.csv");
  const auto value = column(folder_, "there.csv", "value");
  EXPECT_FALSE(std::isnan(value[0]));
  EXPECT_TRUE(std::isnan(value[1]));
}

TEST_F(EvaluateCommand, gives_values_and_derivatives_of_a_plane) {
  fit_plane();
  folder_.write("at.csv", "x,y\n0,0\n0.3,0.7\n2,1\n1.25,0.5\n");
  expect_success(folder_, "evaluate fit.vti --at at.csv --derivatives -o there.csv");
  EXPECT_EQ(lines(folder_.read("there.csv"))[0], "x,y,value,dx,dy,dxx,dxy,dyy");
  const auto near = [](double v) { return testing::DoubleNear(v, 1e-9); };
  EXPECT_THAT(column(folder_, "there.csv", "value"), ElementsAre(near(1), near(-0.5), near(2), near(2)));
  EXPECT_THAT(column(folder_, "there.csv", "dx"), testing::Each(near(2)));
  EXPECT_THAT(column(folder_, "there.csv", "dy"), testing::Each(near(-3)));
  for (const char* const name : {"dxx", "dxy", "dyy"}) {
    EXPECT_THAT(column(folder_, "there.csv", name), testing::Each(near(0))) << name;
  }
}

TEST_F(EvaluateCommand, derivatives_are_differences_of_values) {
  expect_success(folder_, "fit examples/data/topo.csv --x x --y y --value z --cells 16 16 -o fit.vti");
  folder_.write("at.csv", "x,y\n3.001,4\n2.999,4\n3,4.001\n3,3.999\n3,4\n");
  expect_success(folder_, "evaluate fit.vti --at at.csv --derivatives -o there.csv");
  const auto value = column(folder_, "there.csv", "value"), dx = column(folder_, "there.csv", "dx");
  const auto dy = column(folder_, "there.csv", "dy");
  const double step = 2e-3, error = 1e-3;  // third derivatives of some 100 times the square of the step
  EXPECT_NEAR((value[0] - value[1]) / step, dx[4], error);
  EXPECT_NEAR((value[2] - value[3]) / step, dy[4], error);
  EXPECT_NEAR((dx[0] - dx[1]) / step, column(folder_, "there.csv", "dxx")[4], 10 * error);
  EXPECT_NEAR((dx[2] - dx[3]) / step, column(folder_, "there.csv", "dxy")[4], 10 * error);
  EXPECT_NEAR((dy[2] - dy[3]) / step, column(folder_, "there.csv", "dyy")[4], 10 * error);
}

TEST_F(EvaluateCommand, leaves_fields_outside_the_region_empty_and_counts_them) {
  fit_plane();
  folder_.write("at.csv", "x,y\n1,0.5\n-1,0.5\n1,7\n");
  const Outcome run = expect_success(folder_, "evaluate fit.vti --at at.csv --derivatives -o there.csv");
  EXPECT_THAT(run.err, HasSubstr("batten: note: 2 of 3 points lie outside the region (x from 0 to 2, y from 0 to 1)"));
  EXPECT_THAT(run.out, HasSubstr("3 points evaluated, 2 outside the region"));
  const std::vector<std::string> rows = lines(folder_.read("there.csv"));
  EXPECT_EQ(rows[2], "-1,0.5,,,,,,");
  EXPECT_EQ(rows[3], "1,7,,,,,,");
}

TEST_F(EvaluateCommand, finds_the_columns_by_their_names_or_takes_the_first_two) {
  fit_plane();
  const auto value_at = [&](const std::string& table, const std::string& options) {
    folder_.write("at.csv", table);
    expect_success(folder_, "evaluate fit.vti --at at.csv -o there.csv" + options);
    return column(folder_, "there.csv", "value").at(0);
  };
  const double expected = 1 + 2 * 1.5 - 3 * 0.25;
  EXPECT_NEAR(value_at("x,y\n1.5,0.25\n", ""), expected, 1e-9);
  EXPECT_NEAR(value_at("name;y;x\nhut;0.25;1.5\n", ""), expected, 1e-9);
  EXPECT_NEAR(value_at("\xEF\xBB\xBF\"x\",\"name\",\"y\"\n1.5,hut,0.25\n", ""), expected, 1e-9);
  EXPECT_NEAR(value_at("lon lat\n1.5 0.25\n", ""), expected, 1e-9);
  EXPECT_NEAR(value_at("x,y,lon,lat\n0,0,1.5,0.25\n", " --x lon --y 4"), expected, 1e-9);
}

TEST_F(EvaluateCommand, reads_standard_input_and_is_quiet_when_asked) {
  fit_plane();
  RunOptions options;
  options.input = "x,y\n1.5,0.25\n9,9\n";
  const Outcome run = expect_success(folder_, "evaluate fit.vti --at - -o there.csv --quiet --threads 1", options);
  EXPECT_THAT(run.out, IsEmpty());
  EXPECT_THAT(run.err, IsEmpty());
  EXPECT_NEAR(column(folder_, "there.csv", "value")[0], 3.25, 1e-9);
}

TEST_F(EvaluateCommand, refuses_what_is_no_result) {
  const Folder folder;
  folder.write("at.csv", "x,y\n1,2\n");
  folder.write("fit.vti", "no image");
  expect_failure(folder, "evaluate none.vti --at at.csv -o there.csv", 1, "none.vti: there is no such file");
  expect_failure(folder, "evaluate fit.vti --at at.csv -o there.csv", 1, "fit.vti: ");
  expect_failure(folder, "evaluate at.csv --at at.csv -o there.csv", 1, "at.csv: ");
}

TEST_F(EvaluateCommand, refuses_bad_points_and_outputs) {
  fit_plane();
  expect_failure(folder_, "evaluate fit.vti --at none.csv -o there.csv", 1, "none.csv: there is no such file");
  expect_failure(folder_, "evaluate fit.vti --at in.csv --x x --y h -o there.csv", 1, "there is no column 'h'");
  expect_failure(folder_, "evaluate fit.vti --at in.csv -o there.txt", 2, "-o: the name must end with .csv");
  expect_failure(folder_, "evaluate fit.vti --at in.csv -o in.csv", 2, "is an input and would be overwritten");
  expect_failure(folder_, "evaluate fit.vti --at in.csv -o no/there.csv", 1, "the output folder no does not exist");
  expect_failure(folder_, "evaluate fit.vti --at in.csv --x x -o there.csv", 2, "--x requires --y");
}

}  // namespace
}  // namespace batten::test
