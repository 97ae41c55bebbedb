// SPDX-License-Identifier: MIT
#include <batten/app/problem_file.h>
#include <batten/app/problem_templates.h>

#include <gtest/gtest.h>

namespace batten {
namespace {

TEST(ProblemTemplates, are_problems) {
  for (const std::string name : {"poisson", "plate", "heat", "vibration", "foundation", "stokes"})
    EXPECT_NO_THROW(parse_problem(problem_template(name), name)) << name;
  EXPECT_TRUE(parse_problem(problem_template("heat"), "").motion);
  EXPECT_TRUE(parse_problem(problem_template("vibration"), "").modes);
  EXPECT_TRUE(parse_problem(problem_template("stokes"), "").flow);
  EXPECT_EQ(problem_template("stoks"), nullptr);
}

TEST(ProblemExamples, are_problems) {
  for (const std::string name :
       {"membrane_pegs", "clamped_plate", "lithosphere", "chladni", "heat_checkerboard", "lid_cavity"})
    EXPECT_NO_THROW(read_problem(std::string(BATTEN_DATA "/") + name + ".toml")) << name;
}

}  // namespace
}  // namespace batten
