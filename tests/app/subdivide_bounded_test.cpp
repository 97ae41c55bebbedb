// SPDX-License-Identifier: MIT
#include <batten/tests/app/command_run.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace batten::test {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

class SubdivideBounded : public ::testing::Test {
protected:
  Outcome run(const std::string& arguments) { return run_batten(folder_, words("subdivide " + arguments)); }

  std::vector<double> values(const std::string& arguments) {
    const Outcome outcome = run(arguments + " -o out.csv --quiet");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return column(folder_, "out.csv", "value");
  }

  void expect_failure(const std::string& arguments, int status, const std::string& message) {
    const Outcome outcome = run(arguments + " -o a.csv");
    expect_refusal(outcome, status, message);
    EXPECT_FALSE(folder_.has("a.csv"));
  }

  Folder folder_;
};

TEST_F(SubdivideBounded, gives_the_printed_corner_rule_of_harmonic_splines) {
  // [Warren & Weimer 2001, fig. 6.12], S_0 on [0,4]^2: the row of the corner is read off columns of unit vectors
  const auto corner = [&](int j, int i) {
    std::string text;
    for (int b = 0; b < 5; ++b)
      for (int a = 0; a < 5; ++a) text += std::string(a == i && b == j ? "1" : "0") + (a == 4 ? "\n" : ",");
    folder_.write("unit.csv", text);
    return values("unit.csv --scheme bounded-harmonic --levels 1")[0];
  };
  EXPECT_NEAR(corner(0, 0), 1.4534, 6e-5);
  EXPECT_NEAR(corner(0, 1), -0.2556, 6e-5);
  EXPECT_NEAR(corner(1, 1), 0.0838, 6e-5);
  EXPECT_NEAR(corner(2, 3), 0.0021, 6e-5);
}

TEST_F(SubdivideBounded, agrees_with_the_reflected_mask_of_the_plane) {
  // on a rectangle the exact scheme is the exact mask of the plane with data mirrored at all sides
  const std::string plate = "examples/data/plate.csv --levels 2 --scheme ";
  const auto bounded = values(plate + "bounded-harmonic");
  const auto reflected = values(plate + "polyharmonic --order 1 --method laurent --size 41");
  ASSERT_EQ(bounded.size(), reflected.size());
  for (std::size_t i = 0; i < bounded.size(); ++i) EXPECT_NEAR(bounded[i], reflected[i], 5e-3);
}

TEST_F(SubdivideBounded, padded_rules_are_near_the_exact_ones) {
  for (const std::string name : {"bounded-harmonic", "bounded-thin-plate", "bounded-tension"}) {
    const std::string plate = "examples/data/plate.csv --levels 2 --scheme " + name;
    const auto exact = values(plate), padded = values(plate + " --rules padded");
    ASSERT_EQ(exact.size(), padded.size());
    double largest = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) largest = std::max(largest, std::abs(exact[i] - padded[i]));
    EXPECT_LT(largest, 0.1) << name;
    EXPECT_GT(largest, 1e-6) << name;
  }
}

TEST_F(SubdivideBounded, keeps_what_has_no_energy) {
  std::string plane;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i) plane += std::string("7") + (i == 4 ? "\n" : ",");
  folder_.write("level.csv", plane);
  for (const std::string name : {"bounded-harmonic", "bounded-thin-plate", "bounded-tension --tension 0.5"})
    for (const std::string rules : {" --rules exact", " --rules padded"})
      for (double v : values("level.csv --levels 2 --scheme " + name + rules))
        EXPECT_NEAR(v, 7, 1e-10) << name << rules;
}

TEST_F(SubdivideBounded, tells_energies_that_fall_for_bending) {
  const Outcome outcome = run("examples/data/plate.csv --scheme bounded-thin-plate --levels 2 -o out.csv");
  EXPECT_THAT(outcome.out, HasSubstr("8 x 8 values -> 25 x 25, energy 31.8222 -> "));
  double after = 0;
  ASSERT_EQ(std::sscanf(outcome.out.c_str() + outcome.out.find("-> ", outcome.out.find("energy")), "-> %lf", &after),
            1);
  EXPECT_LT(after, 10);
  EXPECT_GT(after, 7.5);
}

TEST_F(SubdivideBounded, says_what_cannot_be) {
  folder_.write("small.csv", "1,2\n3,4\n");
  const std::string plate = "examples/data/plate.csv --scheme bounded-harmonic";
  expect_failure("small.csv --scheme bounded-thin-plate", 1, "needs at least 3 x 3 values, found 2 x 2");
  expect_failure(plate + " --boundary open", 2, "has no option --boundary: its sides are free");
  expect_failure(plate + " --tension 0.5", 2, "bounded-harmonic has no option --tension");
  expect_failure(plate + " --order 2", 2, "bounded-harmonic has no option --order");
  expect_failure("examples/data/plate.csv --scheme four-point --closed", 2, "the input is a control grid");
  expect_failure(plate + " --rules some", 2, "--rules");
  expect_failure(plate + " --interpolate", 2, "has no option of curves");
}

}  // namespace
}  // namespace batten::test
