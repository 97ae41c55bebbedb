// SPDX-License-Identifier: MIT
#include <batten/app/problem_file.h>
#include <batten/domains/errors.h>
#include <batten/tests/app/command_run.h>
#include <batten/tests/support/message_of.h>

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <thread>

namespace batten::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string plate_head = "problem = \"plate\"\nx = [0, 1]\ny = [0, 2]\ncells = [8, 16]\n";
const std::string poisson_head = "problem = \"poisson\"\nx = [0, 1]\ny = [0, 2]\ncells = [8, 16]\n";
const std::string clamped =
    "[sides]\nleft = \"clamped\"\nright = \"clamped\"\nbottom = \"clamped\"\ntop = \"clamped\"\n";
const std::string fixed = "[sides]\nleft = {value = 0}\nright = {value = 0}\nbottom = {value = 0}\ntop = {value = 0}\n";

ProblemFile plate(const std::string& tables) { return parse_problem(plate_head + clamped + tables, "p.toml"); }
ProblemFile poisson(const std::string& tables) { return parse_problem(poisson_head + fixed + tables, "p.toml"); }

std::string refusal(const std::string& text) {
  const std::string message = message_of<InvalidInput>([&] { parse_problem(text, "p.toml"); });
  EXPECT_THAT(message, Not(HasSubstr("\n")));
  return message;
}
// What follows stands in line 10 and below.
std::string plate_refusal(const std::string& tables) { return refusal(plate_head + clamped + tables); }
std::string poisson_refusal(const std::string& tables) { return refusal(poisson_head + fixed + tables); }

std::string sides(const std::string& left, const std::string& others = "\"free\"") {
  return "[sides]\nleft = " + left + "\nright = " + others + "\nbottom = " + others + "\ntop = " + others + "\n";
}

TEST(ProblemFile, holds_what_it_says_of_a_plate) {
  const ProblemFile file = parse_problem(
      "problem = \"plate\"\nx = [0, \"2*pi\"]\ny = [-1, 0.6]\ncells = [256, 160]\ndegree = 4\n"
      "[material]\nD = \"1 + x^2\"\nnu = 0.25\nfoundation = 2\ntension = \"e\"\n"
      "[load]\nq = \"sin(x)\"\npoints = [{x = 0.5, y = 0.3, value = 1.5}]\n"
      "lines = [{from = [0, 0], to = [1, \"1/2\"], value = \"x*y\"}]\n"
      "patches = [{x = [0, 1], y = [0, 0.5], q = 3}]\n"
      "[supports]\npoints = [{x = 1, y = 0}]\nlines = [{from = [0, 0], to = [1, 0], value = -1}]\n"
      "[sides]\nleft = \"simply-supported\"\nright = {value = \"y\", normal = 2}\nbottom = \"free\"\ntop = "
      "\"symmetry\"\n"
      "[solver]\naccuracy = 1e-8\n",
      "p.toml");
  const BoundaryProblem& p = file.problem;
  ASSERT_TRUE(p.is_plate());
  EXPECT_EQ(p.degree, 4);
  EXPECT_EQ(p.region.x.cells(), 256);
  EXPECT_EQ(p.region.y.cells(), 160);
  EXPECT_DOUBLE_EQ(p.region.x.upper(), 2 * std::numbers::pi);
  const auto& material = std::get<KirchhoffPlate>(p.material);
  EXPECT_DOUBLE_EQ(material.rigidity(2, 0), 5);
  EXPECT_EQ(material.poisson_ratio, 0.25);
  EXPECT_EQ(material.foundation(0, 0), 2);
  EXPECT_TRUE(material.tension.is_constant());
  EXPECT_DOUBLE_EQ(material.tension(0, 0), std::numbers::e);
  EXPECT_DOUBLE_EQ(p.loads.area(1, 0), std::sin(1.));
  EXPECT_EQ(p.loads.points.at(0).value, 1.5);
  EXPECT_EQ(p.loads.lines.at(0).to[1], 0.5);
  EXPECT_DOUBLE_EQ(p.loads.lines.at(0).value(2, 3), 6);
  EXPECT_EQ(p.loads.patches.at(0).y[1], 0.5);
  EXPECT_EQ(p.supports.points.at(0).x, 1);
  EXPECT_EQ(p.supports.lines.at(0).value(0, 0), -1);
  EXPECT_TRUE(p.sides.left.value && !p.sides.left.normal);
  EXPECT_EQ((*p.sides.right.value)(0, 0.25), 0.25);
  EXPECT_EQ((*p.sides.right.normal)(0, 0), 2);
  EXPECT_FALSE(p.sides.bottom.value || p.sides.bottom.normal);
  EXPECT_TRUE(!p.sides.top.value && p.sides.top.normal);
  EXPECT_EQ(file.limits.accuracy, 1e-8);
  EXPECT_FALSE(file.modes || file.motion);
}

TEST(ProblemFile, takes_what_it_does_not_say_from_the_manual) {
  const ProblemFile file = poisson("");
  const auto& material = std::get<Conduction>(file.problem.material);
  EXPECT_EQ(file.problem.degree, 3);
  EXPECT_EQ(material.k(0, 0), 1);
  EXPECT_TRUE(material.c.is_zero());
  EXPECT_TRUE(file.problem.loads.area.is_zero());
  EXPECT_EQ(file.limits.accuracy, 1e-10);
  EXPECT_EQ(poisson("[modes]\n").modes.value().count, 6);
}

TEST(ProblemFile, holds_modes_and_motion) {
  const ProblemFile modes = plate("[modes]\ncount = 9\ndensity = \"2 + x\"\n");
  EXPECT_EQ(modes.modes.value().count, 9);
  EXPECT_EQ(modes.modes.value().density(1, 0), 3);
  const ProblemFile time =
      plate("[time]\nend = 1\nstep = \"1/8\"\ninitial = \"x\"\nvelocity = 2\ndamping = 0.5\ndensity = 7\n");
  EXPECT_EQ(time.motion.value().step, 0.125);
  EXPECT_EQ(time.motion.value().initial(3, 0), 3);
  EXPECT_EQ(time.motion.value().velocity(0, 0), 2);
  EXPECT_EQ(time.motion.value().damping, 0.5);
  EXPECT_EQ(time.motion.value().density(0, 0), 7);
}

TEST(ProblemFile, accepts_periodic_sides_in_pairs) {
  const ProblemFile file = parse_problem(
      poisson_head + "[sides]\nleft = \"periodic\"\nright = \"periodic\"\nbottom = {normal = 1}\ntop = {value = 1}\n",
      "");
  EXPECT_TRUE(file.problem.sides.left.periodic && file.problem.sides.right.periodic);
  EXPECT_FALSE(file.problem.sides.top.periodic);
}

TEST(ProblemFile, fields_may_be_evaluated_by_many_threads) {
  const Field q = plate("[load]\nq = \"x < 0.5 ? sin(pi*x)*y : mod(x, 0.25) + floor(y)\"\n").problem.loads.area;
  std::vector<std::thread> threads;
  std::array<int, 4> wrong = {};
  for (int& count : wrong)
    threads.emplace_back([&q, &count] {
      for (int i = 0; i < 20000; ++i) {
        const double x = i / 20000., y = 3 * x;
        const double expected =
            x < 0.5 ? std::sin(std::numbers::pi * x) * y : x - 0.25 * std::floor(x / 0.25) + std::floor(y);
        if (std::abs(q(x, y) - expected) > 1e-15) ++count;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(wrong, testing::Each(0));
}

TEST(ProblemFile, tables_on_a_grid_are_bilinear) {
  const Folder folder;
  folder.write("D.csv", "y,x,value\n0,0,1\n2,0,3\n0,1,2\n2,1,5\n");
  folder.write("p.toml", plate_head + clamped + "[material]\nD = {table = \"D.csv\"}\n");
  const ProblemFile file = read_problem(folder / "p.toml");
  const Field& D = std::get<KirchhoffPlate>(file.problem.material).rigidity;
  for (const double x : {0., 0.3, 1.})
    for (const double y : {0., 0.7, 2.}) EXPECT_NEAR(D(x, y), 1 + x + y + x * y / 2, 1e-14);
}

TEST(ProblemFile, scattered_tables_are_fitted) {
  const Folder folder;
  std::string table = "x,y,value\n";
  for (int i = 0; i < 40; ++i) {
    const double x = std::fmod(0.618 * i, 1), y = std::fmod(0.414 * i, 2);
    table += std::to_string(x) + ',' + std::to_string(y) + ',' + std::to_string(5 + x - 2 * y) + '\n';
  }
  folder.write("q.csv", table);
  folder.write("p.toml", plate_head + clamped + "[load]\nq = {table = \"q.csv\"}\n");
  const Field q = read_problem(folder / "p.toml").problem.loads.area;
  EXPECT_NEAR(q(0.5, 1), 3.5, 1e-4);
  EXPECT_NEAR(q(0, 0), 5, 1e-4);  // a plane costs no energy, so it is met everywhere
}

TEST(ProblemFile, refuses_what_is_not_toml) {
  EXPECT_THAT(refusal("problem = = 3\n"), StartsWith("p.toml:1:11: is not TOML: "));
}

TEST(ProblemFile, refuses_unknown_keys_at_every_level_and_names_the_nearest) {
  EXPECT_THAT(refusal(plate_head + "degre = 2\n" + clamped),
              StartsWith("p.toml:5:1: unknown key 'degre' in the file; did "
                         "you mean 'degree'? Known are problem, x, y"));
  EXPECT_THAT(plate_refusal("[material]\nk = 1\n"), StartsWith("p.toml:11:1: unknown key 'k' in [material]"));
  EXPECT_THAT(plate_refusal("[material]\nNu = 0.3\n"),
              HasSubstr("did you mean 'nu'? Known are D, nu, foundation, tension"));
  EXPECT_THAT(poisson_refusal("[material]\nD = 1\n"), HasSubstr("Known are k, c"));
  EXPECT_THAT(plate_refusal("[load]\npoints = [{x = 0, y = 0, valu = 1}]\n"),
              StartsWith("p.toml:11:26: unknown key 'valu' in [load.points[0]]; did you mean 'value'?"));
  EXPECT_THAT(plate_refusal("[load]\npatch = []\n"), HasSubstr("did you mean 'patches'?"));
  EXPECT_THAT(plate_refusal("[supports]\nline = []\n"), HasSubstr("did you mean 'lines'?"));
  EXPECT_THAT(plate_refusal("[modes]\nnumber = 3\n"), HasSubstr("unknown key 'number' in [modes]"));
  EXPECT_THAT(plate_refusal("[time]\nstop = 3\n"), HasSubstr("did you mean 'step'?"));
  EXPECT_THAT(poisson_refusal("[time]\nend = 1\nstep = 1\ndamping = 1\n"),
              HasSubstr("unknown key 'damping' in [time]"));
  EXPECT_THAT(plate_refusal("[solver]\naccurate = 3\n"), HasSubstr("did you mean 'accuracy'?"));
  EXPECT_THAT(refusal(plate_head + "[sides]\nlef = \"free\"\n"),
              HasSubstr("unknown key 'lef' in [sides]; did you mean 'left'?"));
  EXPECT_THAT(refusal(plate_head + sides("{val = 1}")),
              HasSubstr("unknown key 'val' in [sides.left]; did you mean 'value'?"));
  EXPECT_THAT(plate_refusal("[load]\nq = {tabel = \"f.csv\"}\n"), HasSubstr("unknown key 'tabel' in [load.q]"));
}

TEST(ProblemFile, refuses_other_problems) {
  EXPECT_THAT(
      refusal("problem = \"plates\"\n"),
      StartsWith("p.toml:1:11: problem: unknown problem \"plates\"; did you mean \"plate\"? Known are poisson, plate"));
  EXPECT_THAT(refusal("problem = 3\n"),
              HasSubstr("problem: \"poisson\", \"plate\" or \"stokes\" is expected, found the number 3"));
  EXPECT_THAT(refusal("x = [0, 1]\n"),
              HasSubstr("p.toml: the key 'problem' is missing; \"poisson\", \"plate\" or \"stokes\" is expected"));
}

TEST(ProblemFile, refuses_a_bad_region) {
  const std::string start = "problem = \"plate\"\n";
  EXPECT_THAT(refusal(start + "y = [0, 1]\n"), HasSubstr("the key 'x' is missing; a range [lower, upper] is expected"));
  EXPECT_THAT(refusal(start + "x = [1, 0]\ny = [0, 1]\n"),
              StartsWith("p.toml:2:5: x: the lower end must be less than the upper, found [1, 0]"));
  EXPECT_THAT(refusal(start + "x = [0, 1, 2]\n"), HasSubstr("a range [lower, upper] is expected, found an array of 3"));
  EXPECT_THAT(refusal(start + "x = [0, \"x\"]\n"),
              HasSubstr("p.toml:2:9: x[1]: a constant is expected, found an expression"));
  const std::string box = start + "x = [0, 1]\ny = [0, 1]\n";
  EXPECT_THAT(refusal(box + "cells = [8, 1]\n"),
              StartsWith("p.toml:4:13: cells[1]: a whole number of at least 2 is expected, found 1"));
  EXPECT_THAT(refusal(box + "cells = [8, 2.5]\n"), HasSubstr("a whole number of at least 2 is expected, found 2.5"));
  EXPECT_THAT(refusal(box + "cells = 8\n"), HasSubstr("the numbers of cells [NX, NY] is expected, found the number 8"));
  EXPECT_THAT(
      refusal(box + "cells = [1000000, 1000000]\n"),
      testing::ContainsRegex("p.toml:4:9: cells: a solution on 1000000 x 1000000 cells needs about .* of memory"));
}

TEST(ProblemFile, refuses_degrees_out_of_range) {
  EXPECT_THAT(refusal(plate_head + "degree = 1\n" + clamped),
              StartsWith("p.toml:5:10: degree: a degree from 2 to 5 is expected for a plate, found 1"));
  EXPECT_THAT(refusal(poisson_head + "degree = 6\n" + fixed), HasSubstr("a degree from 1 to 5 is expected, found 6"));
  EXPECT_THAT(refusal(poisson_head + "degree = 2.5\n" + fixed), HasSubstr("found 2.5"));
  EXPECT_EQ(parse_problem(poisson_head + "degree = 1\n" + fixed, "").problem.degree, 1);
}

TEST(ProblemFile, refuses_expressions_that_do_not_parse_and_says_where) {
  const auto found = [](const std::string& q) { return plate_refusal("[load]\nq = \"" + q + "\"\n"); };
  EXPECT_THAT(found("1 + foo(x)"),
              StartsWith("p.toml:11:10: load.q: the expression \"1 + foo(x)\" does not parse: 'foo' is not known"));
  EXPECT_THAT(found("x + "), HasSubstr("does not parse: it ends too early"));
  EXPECT_THAT(found("(x"), HasSubstr("does not parse: a parenthesis is missing"));
  EXPECT_THAT(found("2x"),
              StartsWith("p.toml:11:7: load.q: the expression \"2x\" does not parse: 'x' is not expected there"));
  EXPECT_THAT(found("x = 3"),
              StartsWith("p.toml:11:8: load.q: the expression \"x = 3\" does not parse: '=' is not expected"));
  EXPECT_THAT(found("x, y"), HasSubstr("one value is expected, found several"));
  EXPECT_THAT(found("min()"), HasSubstr("'min' needs more arguments"));
  EXPECT_THAT(found("sin(x, y)"), HasSubstr("does not parse: "));
  EXPECT_THAT(found(""), HasSubstr("it is empty"));
  EXPECT_THAT(plate_refusal("[load]\nq = true\n"),
              HasSubstr("a number, an expression or {table = \"FILE.csv\"} is expected, found true"));
}

TEST(ProblemFile, refuses_fields_that_are_not_finite_and_says_where) {
  EXPECT_THAT(plate_refusal("[load]\nq = \"sqrt(x - 0.5)\"\n"),
              StartsWith("p.toml:11:5: load.q: must be finite, found nan at x = 0, y = 0"));
  EXPECT_THAT(plate_refusal("[load]\nq = \"1/(y - 2)\"\n"), HasSubstr("must be finite, found inf at x = 0, y = 2"));
  EXPECT_THAT(plate_refusal("[load]\nq = \"log(0)\"\n"), HasSubstr("must be finite, found inf"));
  EXPECT_THAT(plate_refusal("[load]\nq = inf\n"), HasSubstr("must be finite, found inf"));
  EXPECT_THAT(refusal(poisson_head + sides("{value = \"sqrt(y - 1)\"}")),
              StartsWith("p.toml:6:17: sides.left.value: must be finite, found nan at x = 0, y = 0"));
  EXPECT_THAT(plate_refusal("[load]\nlines = [{from = [0, 0], to = [1, 1], value = \"1/(x-1)\"}]\n"),
              HasSubstr("load.lines[0].value: must be finite, found inf at x = 1, y = 1"));
  EXPECT_THAT(plate_refusal("[load]\npatches = [{x = [0.5, 1], y = [0, 1], q = \"1/(x-0.5)\"}]\n"),
              HasSubstr("load.patches[0].q: must be finite, found inf at x = 0.5, y = 0"));
  EXPECT_EQ(refusal(poisson_head + sides("{value = \"sqrt(y)\"}")), "nothing thrown") << "other sides do not matter";
}

TEST(ProblemFile, refuses_coefficients_out_of_range) {
  EXPECT_THAT(plate_refusal("[material]\nnu = -1\n"),
              StartsWith("p.toml:11:6: material.nu: Poisson's ratio must lie in (-1, 0.5], found -1"));
  EXPECT_THAT(plate_refusal("[material]\nnu = 0.51\n"), HasSubstr("must lie in (-1, 0.5], found 0.51"));
  EXPECT_THAT(plate_refusal("[material]\nD = 0\n"), HasSubstr("material.D: must be positive, found 0"));
  EXPECT_THAT(plate_refusal("[material]\nD = \"x - 0.5\"\n"),
              HasSubstr("material.D: must be positive, found -0.5 at x = 0, y = 0"));
  EXPECT_THAT(plate_refusal("[material]\nfoundation = -1\n"),
              HasSubstr("material.foundation: must not be negative, found -1"));
  EXPECT_THAT(plate_refusal("[material]\ntension = -1\n"),
              HasSubstr("material.tension: must not be negative, found -1"));
  EXPECT_THAT(poisson_refusal("[material]\nk = -2\n"), HasSubstr("material.k: must be positive, found -2"));
  EXPECT_THAT(poisson_refusal("[material]\nc = \"-y\"\n"),
              HasSubstr("material.c: must not be negative, found -0.125 at x = 0, y = 0.125"));
}

TEST(ProblemFile, refuses_sides_that_are_missing_unknown_or_of_the_other_problem) {
  EXPECT_THAT(refusal(plate_head), HasSubstr("the key 'sides' is missing"));
  EXPECT_THAT(refusal(plate_head + "[sides]\nleft = \"free\"\nright = \"free\"\nbottom = \"free\"\n"),
              StartsWith("p.toml:5:1: sides: the key 'top' is missing; \"simply-supported\""));
  EXPECT_THAT(refusal(plate_head + sides("\"clampd\"")),
              StartsWith("p.toml:6:8: sides.left: unknown side \"clampd\"; did you mean \"clamped\"?"));
  EXPECT_THAT(refusal(plate_head + sides("0")), HasSubstr("is expected, found the number 0"));
  EXPECT_THAT(refusal(plate_head + sides("{}")), HasSubstr("sides.left: is empty; {value = ...}"));
  EXPECT_THAT(refusal(poisson_head + sides("\"clamped\"")),
              HasSubstr("\"clamped\" is for plates; a Poisson problem takes {value = 0}"));
  EXPECT_THAT(refusal(poisson_head + sides("\"simply-supported\"")), HasSubstr("takes {value = 0}"));
  EXPECT_THAT(refusal(poisson_head + sides("{value = 1, normal = 0}")), HasSubstr("sides.left: is over-determined"));
  EXPECT_THAT(refusal(plate_head + sides("\"periodic\"")),
              HasSubstr("sides.left: is periodic, so right must be \"periodic\" too"));
}

TEST(ProblemFile, refuses_loads_and_supports_of_the_other_problem) {
  EXPECT_THAT(
      poisson_refusal("[load]\npoints = [{x = 0, y = 0, value = 1}]\n"),
      StartsWith("p.toml:11:10: load.points: loads at points are for plates: the solution of a Poisson problem is not "
                 "bounded there in two dimensions"));
  EXPECT_THAT(poisson_refusal("[supports]\npoints = [{x = 0, y = 0}]\n"),
              HasSubstr("supports.points[0]: a support of a Poisson problem needs a radius: the value at a bare point "
                        "is not bounded"));
  EXPECT_THAT(plate_refusal("[supports]\npoints = [{x = 0, y = 0, radius = 1}]\n"),
              HasSubstr("supports.points[0].radius: is for Poisson problems"));
  EXPECT_THAT(poisson_refusal("[supports]\npoints = [{x = 0, y = 0, radius = 0}]\n"),
              HasSubstr("must be positive, found 0"));
  EXPECT_THAT(
      plate_refusal("[load]\npoints = {x = 0, y = 0, value = 1}\n"),
      HasSubstr("load.points: an array of tables [{x = 0.5, y = 0.5, value = 1}, ...] is expected, found a table"));
  EXPECT_THAT(plate_refusal("[load]\npoints = [{x = 0, y = 0}]\n"),
              HasSubstr("load.points[0]: the key 'value' is missing; a force is expected"));
}

TEST(ProblemFile, refuses_what_lies_outside_the_region_or_is_empty) {
  EXPECT_THAT(plate_refusal("[load]\npoints = [{x = 1.5, y = 0, value = 1}]\n"),
              StartsWith("p.toml:11:11: load.points[0]: (1.5, 0) lies outside the region, x 0 to 1, y 0 to 2"));
  EXPECT_THAT(plate_refusal("[supports]\npoints = [{x = 0, y = -1}]\n"),
              HasSubstr("supports.points[0]: (0, -1) lies outside"));
  EXPECT_THAT(plate_refusal("[load]\nlines = [{from = [0, 0], to = [0, 3], value = 1}]\n"),
              HasSubstr("load.lines[0].to: (0, 3) lies outside"));
  EXPECT_THAT(plate_refusal("[load]\npatches = [{x = [0, 3], y = [0, 1], q = 1}]\n"),
              HasSubstr("load.patches[0]: (3, 1) lies outside"));
  EXPECT_THAT(plate_refusal("[load]\npatches = [{x = [1, 1], y = [0, 1], q = 1}]\n"),
              HasSubstr("load.patches[0].x: the lower end must be less than the upper, found [1, 1]"));
  EXPECT_THAT(plate_refusal("[supports]\nlines = [{from = [1, 1], to = [1, 1]}]\n"),
              HasSubstr("supports.lines[0]: the line has no length"));
}

TEST(ProblemFile, refuses_bad_tables) {
  const Folder folder;
  const auto found = [&](const std::string& csv) {
    if (!csv.empty()) folder.write("q.csv", csv);
    folder.write("p.toml", plate_head + clamped + "[load]\nq = {table = \"q.csv\"}\n");
    return message_of<InvalidInput>([&] { read_problem(folder / "p.toml"); });
  };
  EXPECT_THAT(found(""), HasSubstr("p.toml:11:14: load.q.table: "));
  EXPECT_THAT(found(""), HasSubstr("q.csv: there is no such file"));
  EXPECT_THAT(found("x,y,z\n0,0,1\n"), HasSubstr("there is no column 'value'"));
  EXPECT_THAT(found("x,y,value\n0,0,a\n"), HasSubstr("line 2"));
  EXPECT_THAT(
      found("x,y,value\n0,0,1\n0,2,1\n0.5,0,1\n0.5,2,1\n"),
      HasSubstr(
          "load.q.table: q.csv covers x from 0 to 0.5, y from 0 to 2 only; a value is needed at x = 0.625, y = 0"));
  EXPECT_THAT(found("x,y,value\n0,0,1\n1,2,1\n"), HasSubstr("the points are no full grid and cannot be fitted"));
  EXPECT_THAT(plate_refusal("[load]\nq = {table = 3}\n"),
              HasSubstr("the name of a CSV file is expected, found the number 3"));
  EXPECT_THAT(plate_refusal("[load]\nq = {}\n"), HasSubstr("the key 'table' is missing"));
}

TEST(ProblemFile, refuses_bad_modes_times_and_accuracies) {
  EXPECT_THAT(plate_refusal("[modes]\ncount = 0\n"),
              HasSubstr("modes.count: a whole number of at least 1 is expected, found 0"));
  EXPECT_THAT(plate_refusal("[modes]\ncount = 17\n"), HasSubstr("at most 16 modes are found on these cells"));
  EXPECT_THAT(plate_refusal("[modes]\ndensity = 0\n"), HasSubstr("modes.density: must be positive, found 0"));
  EXPECT_THAT(plate_refusal("[time]\nend = 1\n"),
              HasSubstr("time: the key 'step' is missing; a time step is expected"));
  EXPECT_THAT(plate_refusal("[time]\nend = 1\nstep = 0\n"), HasSubstr("time.step: must be positive, found 0"));
  EXPECT_THAT(plate_refusal("[time]\nend = 0.1\nstep = 1\n"),
              HasSubstr("time.end: must not be less than the step 1, found 0.1"));
  EXPECT_THAT(plate_refusal("[time]\nend = 1\nstep = 1e-7\n"), HasSubstr("time.step: makes 1e+07 steps"));
  EXPECT_THAT(plate_refusal("[time]\nend = 1\nstep = 1\ndamping = -1\n"),
              HasSubstr("time.damping: must not be negative, found -1"));
  EXPECT_THAT(plate_refusal("[time]\nend = 1\nstep = 1\ndensity = \"-x\"\n"),
              HasSubstr("time.density: must be positive"));
  EXPECT_THAT(plate_refusal("[modes]\n[time]\nend = 1\nstep = 1\n"), HasSubstr("time: is there beside [modes]"));
  EXPECT_THAT(plate_refusal("[solver]\naccuracy = 1\n"),
              StartsWith("p.toml:11:12: solver.accuracy: must lie between 0 and 1, found 1"));
  EXPECT_THAT(plate_refusal("[solver]\naccuracy = 0\n"), HasSubstr("must lie between 0 and 1, found 0"));
  EXPECT_THAT(plate_refusal("modes = 3\n"), HasSubstr("did you mean")) << "it stands in [sides]";
}

TEST(ProblemFile, refuses_a_table_that_is_none) {
  EXPECT_THAT(refusal("problem = \"plate\"\nx = [0, 1]\ny = [0, 1]\ncells = [4, 4]\nmodes = 3\n" + clamped),
              StartsWith("p.toml:5:9: modes: a table with the keys count, density is expected, found the number 3"));
}

}  // namespace
}  // namespace batten::test
