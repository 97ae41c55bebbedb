// SPDX-License-Identifier: MIT
#include <batten/app/problem_file.h>
#include <batten/domains/errors.h>
#include <batten/tests/support/message_of.h>

#include <gmock/gmock.h>

namespace batten::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string head = "problem = \"stokes\"\nx = [0, 2]\ny = [0, 1]\ncells = [16, 8]\n";

std::string sides(const std::string& left, const std::string& right = "\"wall\"") {
  return "[sides]\nleft = " + left + "\nright = " + right + "\nbottom = \"wall\"\ntop = \"wall\"\n";
}

const std::string walls = sides("\"wall\"");

std::string refusal(const std::string& tables) {
  const std::string message = message_of<InvalidInput>([&] { parse_problem(head + tables, "p.toml"); });
  EXPECT_THAT(message, Not(HasSubstr("\n")));
  return message;
}

TEST(StokesProblemFile, holds_what_it_says) {
  const ProblemFile file = parse_problem(
      head +
          "degree = 4\n[material]\nmu = \"2*pi\"\n[load]\nfx = \"x*y\"\nfy = -1\npoints = [{x = 1, y = 0.25, fx = 3, "
          "fy "
          "= \"1/2\"}]\n[sides]\nleft = {u = \"y\", v = 0}\nright = \"free\"\nbottom = \"symmetry\"\ntop = {u = 1, v = "
          "0}\n[solver]\naccuracy = 1e-6\n",
      "p.toml");
  ASSERT_TRUE(file.flow);
  EXPECT_STREQ(file.kind(), "stokes");
  const StokesProblem& flow = *file.flow;
  EXPECT_EQ(flow.degree, 4);
  EXPECT_EQ(flow.region.x.cells(), 16);
  EXPECT_DOUBLE_EQ(flow.viscosity, 2 * std::acos(-1.));
  EXPECT_EQ(flow.force_x(2, 0.5), 1);
  EXPECT_EQ(flow.force_y(2, 0.5), -1);
  ASSERT_EQ(flow.point_forces.size(), 1u);
  EXPECT_EQ(flow.point_forces[0].y, 0.25);
  EXPECT_EQ(flow.point_forces[0].fx, 3);
  EXPECT_EQ(flow.point_forces[0].fy, 0.5);
  EXPECT_EQ(flow.left.u(0, 0.3), 0.3);
  EXPECT_EQ(flow.right.kind, StokesSide::Kind::Free);
  EXPECT_EQ(flow.bottom.kind, StokesSide::Kind::Symmetry);
  EXPECT_EQ(flow.top.u(0, 1), 1);
  EXPECT_EQ(file.limits.accuracy, 1e-6);
}

TEST(StokesProblemFile, must_say_how_the_fluid_moves_on_every_side) {
  const std::string choices = "{u = ..., v = ...}, \"wall\", \"symmetry\" or \"free\"";
  EXPECT_THAT(refusal(""), HasSubstr("the key 'sides' is missing"));
  EXPECT_THAT(refusal("[sides]\nleft = \"wall\"\n"), HasSubstr("the key 'right' is missing; " + choices));
  EXPECT_THAT(refusal(sides("{u = 1}")),
              HasSubstr("the key 'v' is missing; a velocity in both directions, {u = ..., v = ...}, is expected"));
  EXPECT_THAT(refusal(sides("{value = 1}")), HasSubstr("unknown key 'value' in [sides.left]"));
  EXPECT_THAT(refusal(sides("\"clamped\"")),
              AllOf(StartsWith("p.toml:6:8: sides.left: unknown side \"clamped\""), HasSubstr(choices)));
  EXPECT_THAT(refusal(sides("\"wal\"")), HasSubstr("did you mean \"wall\"?"));
  EXPECT_THAT(refusal(sides("\"periodic\"")), HasSubstr("how much flows through periodic sides is not determined"));
  EXPECT_THAT(refusal(sides("1")), HasSubstr(choices + " is expected, found the number 1"));
  EXPECT_THAT(refusal(sides("{u = \"1/y\", v = 0}")), HasSubstr("must be finite"));
}

TEST(StokesProblemFile, must_let_out_what_it_lets_in) {
  EXPECT_THAT(
      refusal(sides("{u = 0.5, v = 0}")),
      AllOf(StartsWith("p.toml:5:1: sides: "), HasSubstr("a net inflow of 0.5 (in 0.5, out 0); at most 1e-09")));
  EXPECT_THAT(refusal(sides("\"free\"", "\"free\"")), HasSubstr("at most one free side"));
}

TEST(StokesProblemFile, refuses_what_a_slow_flow_has_not) {
  EXPECT_THAT(refusal(walls + "[supports]\npoints = [{x = 1, y = 0.5}]\n"), HasSubstr("is held by its sides alone"));
  EXPECT_THAT(refusal(walls + "[modes]\ncount = 3\n"), HasSubstr("has no inertia and does not vibrate"));
  EXPECT_THAT(refusal(walls + "[time]\nend = 3\n"), HasSubstr("follows its sides at once"));
  EXPECT_THAT(refusal(walls + "[material]\ndensity = 3\n"), HasSubstr("unknown key 'density' in [material]"));
  EXPECT_THAT(refusal(walls + "[material]\nD = 3\n"), HasSubstr("unknown key 'D' in [material]"));
  EXPECT_THAT(refusal(walls + "[material]\nmu = 0\n"), HasSubstr("material.mu: must be positive, found 0"));
  EXPECT_THAT(refusal(walls + "[material]\nmu = {table = \"a.csv\"}\n"),
              HasSubstr("viscosity of a slow flow is constant"));
  EXPECT_THAT(refusal(walls + "[load]\nq = 3\n"), HasSubstr("the force per area on a flow is fx and fy"));
  EXPECT_THAT(refusal(walls + "[load]\nlines = []\n"), HasSubstr("takes fx, fy and points"));
  EXPECT_THAT(refusal(walls + "[load]\npatches = []\n"), HasSubstr("takes fx and fy"));
  EXPECT_THAT(refusal(walls + "[load]\nf = 3\n"),
              HasSubstr("unknown key 'f' in [load]; did you mean 'fx'? Known are fx, fy, points"));
  EXPECT_THAT(refusal(walls + "[load]\npoints = [{x = 0.5, y = 0.5, value = 1}]\n"), HasSubstr("unknown key 'value'"));
  EXPECT_THAT(refusal(walls + "[load]\npoints = [{x = 0.5, y = 0.5, fx = 1}]\n"), HasSubstr("the key 'fy' is missing"));
  EXPECT_THAT(refusal(walls + "[load]\npoints = [{x = 3, y = 0.5, fx = 1, fy = 1}]\n"),
              HasSubstr("(3, 0.5) lies outside the region"));
  const std::string message = message_of<InvalidInput>([] { parse_problem(head + "degree = 1\n" + walls, "p.toml"); });
  EXPECT_THAT(message, HasSubstr("a degree from 2 to 5 is expected for a flow, found 1"));
}

}  // namespace
}  // namespace batten::test
