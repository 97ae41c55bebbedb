// SPDX-License-Identifier: MIT
#include <batten/tests/app/command_run.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace batten::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

/// Arguments that may have blanks.
Outcome run(const Folder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "scheme");
  return run_batten(folder, arguments);
}

json account(std::vector<std::string> arguments) {
  const Folder folder;
  arguments.emplace_back("--json");
  const Outcome outcome = run(folder, arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return json::parse(outcome.out);
}

void expect_failure(const std::vector<std::string>& arguments, int status, const std::string& message) {
  const Folder folder;
  const Outcome outcome = run(folder, arguments);
  expect_refusal(outcome, status, message);
  EXPECT_THAT(outcome.err, testing::StartsWith("batten scheme: "));
  EXPECT_THAT(folder.names(), testing::IsEmpty());
}

TEST(SchemeCommand, tells_everything_of_the_four_point_scheme) {  // [Warren & Weimer 2001, sec. 6.1], reference 6.1
  const json found = account({"four-point"});
  EXPECT_EQ(found["dimension"], 1);
  EXPECT_EQ(found["arity"], 2);
  EXPECT_EQ(found["mask"]["offset"], -3);
  EXPECT_EQ(found["mask"]["coefficients"], json::parse(R"(["-1/16","0","9/16","1","9/16","0","-1/16"])"));
  EXPECT_EQ(found["support"], json::parse(R"(["-3","3"])"));
  EXPECT_EQ(found["sum_rules"], 4);
  EXPECT_EQ(found["reproduction_degree"], 3);
  EXPECT_EQ(found["values"]["coefficients"], json::parse(R"(["1"])"));
  EXPECT_EQ(found["derivatives"]["1"]["coefficients"], json::parse(R"(["-1/12","2/3","0","-2/3","1/12"])"));
  EXPECT_FALSE(found["derivatives"].contains("2"));
  EXPECT_EQ(found["inner_products"]["0,1"]["offset"], -5);
  EXPECT_EQ(found["inner_products"]["0,1"]["coefficients"],
            json::parse(R"(["1/665280","4/10395","-481/73920","731/6930","-3659/5280","0","3659/5280","-731/6930",
                            "481/73920","-4/10395","-1/665280"])"));
  EXPECT_EQ(found["smoothness"]["continuity"], 1);
  EXPECT_THAT(found["smoothness"]["certificate"],
              testing::StartsWith("C^1 because ‖T_2^2‖ = 3/4 < 1; not C^2 because"));
  EXPECT_LE(found["smoothness"]["hoelder_lower"].get<double>(), 2);
  EXPECT_GE(found["smoothness"]["hoelder_upper"].get<double>(), 2);
}

TEST(SchemeCommand, tells_values_and_stiffness_of_the_three_direction_quartic) {  // reference 2.18
  const json found = account({"box", "--directions", "1,0;1,0;0,1;0,1;1,1;1,1"});
  EXPECT_EQ(found["values"]["offset"], json::parse("[1,1]"));
  EXPECT_EQ(found["values"]["coefficients"],
            json::parse(R"([["1/12","1/12","0"],["1/12","1/2","1/12"],["0","1/12","1/12"]])"));
  const json& stiffness = found["inner_products"]["1,0;1,0"];
  EXPECT_EQ(stiffness["offset"], json::parse("[-3,-3]"));
  EXPECT_EQ(stiffness["coefficients"][3][3], "17/36");
  EXPECT_FALSE(found.contains("smoothness"));
}

TEST(SchemeCommand, answers_only_what_is_asked) {
  const json found = account({"bspline", "--order", "4", "--inner-product", "2,2", "--derivative", "2"});
  EXPECT_FALSE(found.contains("values"));
  EXPECT_EQ(found["derivatives"]["2"]["coefficients"], json::parse(R"(["1","-2","1"])"));
  EXPECT_EQ(found["inner_products"]["2,2"]["coefficients"],
            json::parse(R"(["1/6","0","-3/2","8/3","-3/2","0","1/6"])"));  // (1, 0, -9, 16, ...) / 6
  const json finer = account({"bspline", "--order", "2", "--values", "--level", "1"});
  EXPECT_EQ(finer["values"]["coefficients"], json::parse(R"(["1/2","1","1/2"])"));
}

TEST(SchemeCommand, gives_splines_that_jump_their_values_from_the_right) {
  EXPECT_EQ(account({"bspline", "--order", "1"})["values"]["coefficients"], json::parse(R"(["1"])"));
  EXPECT_EQ(account({"box", "--directions", "1,0;0,1"})["values"]["coefficients"], json::parse(R"([["1"]])"));
}

TEST(SchemeCommand, knows_every_name_of_its_help) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"exponential", "--roots", "0,0,1,-1", "--level", "2"},
           {"tension", "--sigma", "0"},
           {"deslauriers-dubuc", "--points", "6"},
           {"six-point", "--w", "1/96"},
           {"ternary-four-point", "--w", "1/11"},
           {"butterfly", "--w", "1/16", "--values"},
           {"quad-interpolatory", "--values"},
           {"custom", "--mask", "1/8,1/2,3/4,1/2,1/8", "--offset", "-2"},
           {"custom", "--mask", "1/4,1/2,1/4;1/2,1,1/2;1/4,1/2,1/4", "--offset", "-1,-1", "--values"}}) {
    const json found = account(arguments);
    EXPECT_TRUE(found.contains("mask")) << arguments[0];
    EXPECT_TRUE(found.contains("values")) << arguments[0];
  }
}

TEST(SchemeCommand, gives_the_tension_scheme_of_a_square_the_values_of_a_circle) {  // sigma = cos(2 pi / 4) = 0
  const json found = account({"tension", "--sigma", "0", "--level", "1"});
  EXPECT_EQ(found["level"], 1);
  EXPECT_LT(found["values_error"].get<double>(), 1e-12);
  double sum = 0;
  for (const auto& v : found["values"]["coefficients"]) sum += v.get<double>();
  EXPECT_NEAR(sum, 2, 1e-10);
}

TEST(SchemeCommand, prints_a_table_for_a_reader) {
  const Folder folder;
  const Outcome outcome = run(folder, {"bspline", "--order", "4", "--values", "--smoothness"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, HasSubstr("1/8 + 1/2 x + 3/4 x^2 + 1/2 x^3 + 1/8 x^4"));
  EXPECT_THAT(outcome.out, HasSubstr("1/6, 2/3, 1/6   from 1"));
  EXPECT_THAT(outcome.out, HasSubstr("C^2 because"));
}

TEST(SchemeCommand, writes_pictures_and_files) {
  if (!has_vtk) GTEST_SKIP() << "built without VTK";
  const Folder folder;
  EXPECT_EQ(run(folder, {"four-point", "--quiet", "--picture", "n.png", "-o", "n.vtp"}).status, 0);
  EXPECT_EQ(run(folder, {"butterfly", "--quiet", "--values", "--picture", "b.png", "-o", "b.vti"}).status, 0);
  EXPECT_EQ(run(folder, {"bspline", "--order", "4", "--values", "--quiet", "--closed", "--control", "0,0;1,2;3,2;4,0",
                         "--picture", "c.png", "-o", "c.vtp"})
                .status,
            0);
  EXPECT_THAT(folder.names(), ElementsAre("b.png", "b.vti", "c.png", "c.vtp", "n.png", "n.vtp"));
  for (const std::string name : {"b.png", "c.png", "n.png"}) EXPECT_EQ(folder.read(name).substr(1, 3), "PNG");
}

TEST(SchemeCommand, refuses_names_and_options_it_does_not_know) {
  expect_failure(
      {"b-spline"}, 2,
      "there is no scheme 'b-spline'; did you mean 'bspline'? The schemes are bspline, box, exponential, tension, "
      "four-point, "
      "deslauriers-dubuc, six-point, ternary-four-point, butterfly, quad-interpolatory, polyharmonic, custom");
  expect_failure({"bspline"}, 2, "bspline needs --order");
  expect_failure({"four-point", "--order", "4"}, 2, "four-point has no option --order");
  expect_failure({"box", "--directions", "1,0;a"}, 2,
                 "--directions: expected integers separated by , and ;, found '1,0;a'");
  expect_failure({"exponential", "--roots", "0,x"}, 2, "--roots: expected numbers such as");
  expect_failure({"four-point", "--inner-product", "1"}, 2, "--inner-product: expected r,s, found '1'");
  expect_failure({"four-point", "-o", "a.vti"}, 2, "the name must end with .vtp");
}

TEST(SchemeCommand, refuses_directions_that_do_not_span_the_plane) {
  expect_failure({"box", "--directions", "1,0;2,0"}, 1, "span");
}

TEST(SchemeCommand, says_which_coset_sums_to_what_where_constants_are_not_kept) {
  expect_failure({"custom", "--mask", "1/2,1,1/4,1/4", "--values"}, 1, "3/4");
}

TEST(SchemeCommand, says_so_where_a_scheme_does_not_converge) {
  expect_failure({"four-point", "--w", "1"}, 1, "does not converge");
}

TEST(SchemeCommand, says_so_where_a_derivative_does_not_exist) {
  expect_failure({"four-point", "--derivative", "2"}, 1, "no second derivative");
}

}  // namespace
}  // namespace batten::test
