// SPDX-License-Identifier: MIT
#include <batten/tests/app/command_run.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

namespace batten::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

Outcome run(const Folder& folder, const std::string& arguments) {
  return run_batten(folder, words("scheme " + arguments));
}

json account(const std::string& arguments) {
  const Folder folder;
  const Outcome outcome = run(folder, arguments + " --json");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return json::parse(outcome.out);
}

void expect_failure(const std::string& arguments, int status, const std::string& message) {
  const Folder folder;
  const Outcome outcome = run(folder, arguments);
  expect_refusal(outcome, status, message);
  EXPECT_THAT(folder.names(), testing::IsEmpty());
}

// Numbers are those of variational.md, section 5.2.

TEST(PolyharmonicCommand, tells_the_optimum_of_size_five) {
  const json found = account("polyharmonic --order 1 --method lp --size 5");
  EXPECT_EQ(found["residual_exact"], "8/33");
  EXPECT_NEAR(found["residual"].get<double>(), 8. / 33, 1e-15);
  EXPECT_EQ(found["mask"]["offset"], json::parse("[-2,-2]"));
  EXPECT_EQ(found["mask"]["coefficients"][2], json::parse(R"(["-4/33","5/11","16/11","5/11","-4/33"])"));
  EXPECT_EQ(found["coset_sums"], json::parse(R"([["32/33","34/33"],["34/33","32/33"]])"));
  EXPECT_EQ(found["sum_rules"], 0);
  EXPECT_EQ(found["reproduction_degree"], -1);
}

TEST(PolyharmonicCommand, tells_the_exact_harmonic_coefficients) {
  const json found = account("polyharmonic --order 1 --method exact --size 9");
  const json& middle = found["mask"]["coefficients"][4];
  EXPECT_EQ(middle[4], "4 - 8/pi");
  EXPECT_EQ(middle[5], "3 - 8/pi");
  EXPECT_EQ(found["sum_rules"], 2);
  EXPECT_EQ(found["reproduction_degree"], 1);
  EXPECT_EQ(account("polyharmonic --order 3 --method exact --size 3")["sum_rules"], 6);
}

TEST(PolyharmonicCommand, tells_the_residuals_of_five_rounds) {
  const json found = account("polyharmonic --order 1 --size 17");
  const std::array printed = {0.002037, 0.004742, 0.006426, 0.008606, 0.010828};
  ASSERT_THAT(found["multilevel_residuals"], SizeIs(5));
  for (std::size_t k = 0; k < printed.size(); ++k)
    EXPECT_NEAR(found["multilevel_residuals"][k].get<double>(), printed[k], 0.51e-6);
  EXPECT_THAT(account("polyharmonic --order 1 --rounds 2")["multilevel_residuals"], SizeIs(2));
}

TEST(PolyharmonicCommand, proves_that_cubic_precision_gives_smooth_limits) {
  const json found = account("polyharmonic --order 2 --size 9 --precision 3 --smoothness");
  EXPECT_NEAR(found["residual"].get<double>(), 0.436029, 0.51e-6);
  EXPECT_EQ(found["sum_rules"], 4);
  EXPECT_EQ(found["smoothness"]["continuity"], 1);
  EXPECT_THAT(found["smoothness"]["certificate"], testing::StartsWith("C^1 because ‖T_2^"));
}

TEST(PolyharmonicCommand, knows_every_method_and_constraint_of_its_help) {
  EXPECT_NEAR(account("polyharmonic --order 1 --method laurent --size 5")["residual"].get<double>(), 0.345562, 1e-6);
  EXPECT_EQ(account("polyharmonic --order 1 --method laurent --size 5 --precision 0")["sum_rules"], 2);
  EXPECT_EQ(account("polyharmonic --order 1 --method jacobi --size 9 --relaxation 1/8")["residual_exact"], "39/64");
  EXPECT_GT(account("polyharmonic --order 1 --method lsq --size 5")["residual"].get<double>(), 8. / 33);
  EXPECT_EQ(account("polyharmonic --order 1 --size 5 --symmetry point")["residual_exact"], "8/33");
  EXPECT_EQ(account("polyharmonic --order 1 --size 5 --shape diamond")["mask"]["coefficients"][0][0], "0");
  EXPECT_EQ(account("polyharmonic --order 1 --size 5 --zeros -1,-1;1,-1;-1,1")["coset_sums"][0][1],
            account("polyharmonic --order 1 --size 5 --zeros -1,-1,1;1,-1,1;-1,1,1")["coset_sums"][1][1]);
}

TEST(PolyharmonicCommand, compares_the_methods) {  // figures 5.16 and 5.17
  const Folder folder;
  const std::string picture = has_vtk ? " --picture c.png" : "";
  const Outcome outcome = run(folder, "polyharmonic --order 1 --compare -o c.csv" + picture);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const auto lp = column(folder, "c.csv", "residual_lp"), laurent = column(folder, "c.csv", "residual_laurent");
  const auto sizes = column(folder, "c.csv", "size"), errors = column(folder, "c.csv", "limit_error_laurent");
  ASSERT_THAT(lp, SizeIs(10));
  EXPECT_THAT(sizes, ElementsAre(5, 9, 13, 17, 21, 17, 17, 17, 17, 17));
  EXPECT_NEAR(lp[3], 0.0020372568, 1e-10);
  EXPECT_NEAR(lp[9], 0.010828, 0.51e-6);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_GT(laurent[k], 1.4 * lp[k]);
  EXPECT_LT(errors[4], errors[0]);
  EXPECT_TRUE(std::isnan(errors[5]));
  EXPECT_EQ(folder.has("c.png"), has_vtk);
}

TEST(PolyharmonicCommand, draws_bases) {
  if (!has_vtk) GTEST_SKIP() << "built without VTK";
  const Folder folder;
  EXPECT_EQ(run(folder, "polyharmonic --order 1 --method exact --quiet --picture e.png -o e.vti").status, 0);
  EXPECT_EQ(run(folder, "polyharmonic --order 2 --precision 3 --quiet --picture m.png -o m.vti").status, 0);
  EXPECT_THAT(folder.names(), ElementsAre("e.png", "e.vti", "m.png", "m.vti"));
}

TEST(PolyharmonicCommand, says_what_cannot_be) {
  expect_failure("polyharmonic", 2, "polyharmonic needs --order");
  expect_failure("polyharmonic --order 0", 1, "must be at least 1, found 0");
  expect_failure("polyharmonic --order 1 --size 4", 1, "odd and at least 3, found 4");
  expect_failure("polyharmonic --order 1 --size 1", 1, "odd and at least 3, found 1");
  expect_failure("polyharmonic --order 1 --method jacobi --size 8", 1, "have sizes 7, 9");
  expect_failure("polyharmonic --order 1 --method simplex", 2,
                 "--method: expected one of exact, laurent, jacobi, lp, lsq, found 'simplex'");
  expect_failure("polyharmonic --order 1 --size 3 --precision 3", 1, "\"precision 3: the derivative (2, 0) at (-1, 1)");
  expect_failure("polyharmonic --order 1 --method laurent --precision 1", 1, "can be given precision 0");
  expect_failure("polyharmonic --order 1 --method jacobi --precision 5", 1, "have precision 1 and no other, found 5");
  expect_failure("polyharmonic --order 1 --method jacobi --shape disc", 2, "--method jacobi has no option --shape");
  expect_failure("polyharmonic --order 1 --values", 2, "polyharmonic has no option --values");
  expect_failure("polyharmonic --order 1 --smoothness", 1, "must sum to 4");
  expect_failure("four-point --compare", 2, "four-point has no option --compare");
}

TEST(QuotientCommand, gives_laurent_coefficients) {  // variational.md, 5.2: -5^(-1/2) ((3-sqrt5)/2)^|i|
  const json found = account("quotient --numerator 1 --denominator 1,-3,1 --size 7")["quotient"];
  EXPECT_EQ(found["offset"], -3);
  for (int i = -3; i <= 3; ++i)
    EXPECT_NEAR(found["coefficients"][static_cast<std::size_t>(i + 3)].get<double>(),
                -std::pow((3 - std::sqrt(5.)) / 2, std::abs(i)) / std::sqrt(5.), 1e-15);
  const json plane = account(
      "quotient --numerator 0,0,1,0,0;0,0,0,0,0;1,0,-4,0,1;0,0,0,0,0;0,0,1,0,0 --size 3 "
      "--denominator 0,1,0;1,-4,1;0,1,0")["quotient"];
  EXPECT_NEAR(plane["coefficients"][1][1].get<double>(), 4 - 8 / M_PI, 1e-13);
  EXPECT_NEAR(plane["coefficients"][1][2].get<double>(), 3 - 8 / M_PI, 1e-13);
}

TEST(QuotientCommand, says_where_a_quotient_is_not_bounded) {
  expect_failure("quotient --numerator 1 --denominator 0,1,0;1,-4,1;0,1,0", 1, "the denominator vanishes at (x, y)");
  expect_failure("quotient --numerator 1 --denominator 1,-2,1", 1, "vanish");
  expect_failure("quotient --numerator 1", 2, "quotient needs --denominator");
  expect_failure("quotient --numerator 1 --denominator 1,-3,1 --size 4", 1, "must be odd");
  expect_failure("quotient --numerator 1 --denominator 1,-3,1 --smoothness", 2, "quotient has no option --smoothness");
}

}  // namespace
}  // namespace batten::test
