// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/vibration.h>

#include "../support/message_of.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace batten {
namespace {

constexpr double pi = std::numbers::pi;

Rectangle square(double side, int cells) { return {Interval(0, side, cells), Interval(0, side, cells)}; }

Sides all(const Side& side) { return {side, side, side, side}; }

BoundaryProblem plate(int cells, int degree, const Side& side) {
  return {KirchhoffPlate{}, square(1, cells), degree, all(side), {}, {}};
}

BoundaryProblem membrane(int cells, int degree, const Side& side) {
  return {Conduction{}, square(1, cells), degree, all(side), {}, {}};
}

/// Checks eigenvalues against known ones, relative to these; 0 must be exact.
void expect_eigenvalues(const std::vector<Mode>& modes, const std::vector<double>& known, double tolerance) {
  ASSERT_EQ(modes.size(), known.size());
  for (std::size_t k = 0; k < known.size(); ++k) EXPECT_NEAR(modes[k].eigenvalue, known[k], tolerance * known[k]) << k;
}

/// The lowest values of f(i, j), i and j from `first`, with their multiplicities.
template <typename Function>
std::vector<double> lowest(std::size_t count, int first, Function&& f) {
  std::vector<double> values;
  for (int i = first; i < first + 16; ++i)
    for (int j = first; j < first + 16; ++j) values.push_back(f(i, j));
  std::ranges::sort(values);
  values.resize(count);
  return values;
}

constexpr double clamped_square = 1294.9339795917;  // [Bjørstad & Tjøstheim 1999]

TEST(Vibration, of_a_clamped_square_plate_has_the_known_lowest_eigenvalue) {
  EXPECT_NEAR(vibration_modes(plate(24, 5, Side::clamped()), 1).front().eigenvalue, clamped_square, 1e-6);
  EXPECT_NEAR(vibration_modes(plate(40, 4, Side::clamped()), 1).front().eigenvalue, clamped_square, 5e-6);
}

TEST(Vibration, of_simply_supported_plates_is_the_product_of_sines_with_all_multiplicities) {
  const auto known = lowest(20, 1, [](int i, int j) { return std::pow(pi * pi * (i * i + j * j), 2); });
  expect_eigenvalues(vibration_modes(plate(32, 5, Side::simply_supported()), 20), known, 1e-8);
  const auto first = vibration_modes(plate(32, 5, Side::simply_supported()), 1);
  EXPECT_NEAR(first.front().eigenvalue, 389.636364136, 1e-9);
  EXPECT_NEAR(first.front().shape.value(0.5, 0.5), 2, 1e-7);  // 2 sin(π x) sin(π y)
}

TEST(Vibration, of_membranes_has_all_multiplicities_for_fixed_and_natural_sides) {
  const auto sum = [](int i, int j) { return pi * pi * (i * i + j * j); };
  expect_eigenvalues(vibration_modes(membrane(32, 4, Side::fixed()), 20), lowest(20, 1, sum), 2e-8);
  const auto free = vibration_modes(membrane(32, 4, Side::free()), 12);
  expect_eigenvalues(free, lowest(12, 0, sum), 2e-8);
  EXPECT_EQ(free.front().eigenvalue, 0);
  EXPECT_NEAR(free.front().shape.value(0.3, 0.8), 1, 1e-13);
}

// Frequencies for ν = 0.3 [Leissa 1973, and later series of more digits].
TEST(Vibration, of_a_free_square_plate_starts_with_three_rigid_motions) {
  const auto modes = vibration_modes(plate(24, 5, Side::free()), 10);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(modes[k].eigenvalue, 0);
  const std::array frequencies = {13.468, 19.596, 24.270, 34.801, 34.801, 61.093, 61.093};
  for (std::size_t k = 0; k < frequencies.size(); ++k)
    EXPECT_NEAR(std::sqrt(modes[3 + k].eigenvalue), frequencies[k], 6e-4) << k;
}

TEST(Vibration, of_a_quarter_plate_with_sides_of_symmetry_is_that_of_the_whole) {
  auto quarter = plate(16, 5, Side::clamped());
  quarter.region = square(0.5, 16);
  quarter.sides.right = quarter.sides.top = Side::symmetry();
  EXPECT_NEAR(vibration_modes(quarter, 1).front().eigenvalue, clamped_square, 1e-6);
}

TEST(Vibration, adds_tension_and_foundation_and_divides_by_density_in_the_units_of_the_problem) {
  auto problem = plate(24, 5, Side::simply_supported());
  problem.region = {Interval(1, 3, 40), Interval(-1, 0, 20)};
  problem.material = KirchhoffPlate{2, 0.2, 7, 5};  // rigidity, Poisson's ratio, foundation, tension
  std::vector<double> known;
  for (int i = 1; i < 5; ++i)
    for (int j = 1; j < 4; ++j) {
      const double wave = pi * pi * (i * i / 4. + j * j);
      known.push_back((2 * wave * wave + 5 * wave + 7) / 3);
    }
  std::ranges::sort(known);
  known.resize(5);
  expect_eigenvalues(vibration_modes(problem, 5, 3.), known, 1e-8);
}

/// The error of one eigenvalue on a square of so many cells.
double error_of(BoundaryProblem problem, int cells, std::size_t index, double known) {
  problem.region = square(1, cells);
  const auto modes = vibration_modes(problem, static_cast<int>(index) + 1, 1, {.limits = {.accuracy = 1e-13}});
  return modes[index].eigenvalue - known;
}

TEST(Vibration, eigenvalues_converge_with_twice_the_order_of_the_energy_norm) {
  const auto expect_order = [](const BoundaryProblem& problem, double known) {
    const int cells = problem.degree > 3 ? 6 : 12, m = problem.is_plate() ? 2 : 1;
    const double coarse = error_of(problem, cells, 3, known), fine = error_of(problem, 2 * cells, 3, known);
    EXPECT_GT(fine, 0) << "Rayleigh's quotients approach from above";
    EXPECT_GT(std::log2(coarse / fine), 2 * (problem.degree + 1 - m) - 0.25)
        << "degree " << problem.degree << ": " << coarse << ", " << fine;
  };
  for (int degree = 1; degree <= 5; ++degree) expect_order(membrane(8, degree, Side::fixed()), 8 * pi * pi);
  for (int degree = 2; degree <= 5; ++degree)
    expect_order(plate(8, degree, Side::simply_supported()), 64 * std::pow(pi, 4));
}

// With k = (1 + x)² or the density (1 + x)^-2, functions of log(1 + x) separate: μ = 1/4 + (π / log 2)².
TEST(Vibration, takes_varying_coefficients_and_densities) {
  const double known = 0.25 + std::pow(pi / std::log(2.), 2);
  auto problem = membrane(24, 4, Side::fixed());
  problem.sides.bottom = problem.sides.top = Side::free();
  const Field density([](double x, double) { return 1 / ((1 + x) * (1 + x)); });
  EXPECT_NEAR(vibration_modes(problem, 1, density).front().eigenvalue, known, 1e-8 * known);
  problem.material = Conduction{Field([](double x, double) { return (1 + x) * (1 + x); }), 0.};
  EXPECT_NEAR(vibration_modes(problem, 1).front().eigenvalue, known, 1e-8 * known);
}

TEST(Vibration, of_varying_coefficients_that_happen_to_be_constant_is_that_of_constant_ones) {
  for (const Side& side : {Side::free(), Side::clamped()}) {
    auto problem = plate(16, 3, side);
    const auto constant = vibration_modes(problem, 5, 2.);
    problem.material = KirchhoffPlate{Field([](double, double) { return 1.; }), 0.3, 0., 0.};
    const auto varying = vibration_modes(problem, 5, Field([](double, double) { return 2.; }));
    for (std::size_t k = 0; k < constant.size(); ++k)
      EXPECT_NEAR(varying[k].eigenvalue, constant[k].eigenvalue, 1e-9 * constant[k].eigenvalue) << k;
  }
}

TEST(Vibration, keeps_modes_whose_nodal_lines_are_supported) {
  auto problem = plate(32, 4, Side::simply_supported());
  problem.supports.lines = {{{0.5, 0}, {0.5, 1}, 3.}};  // the value plays no part
  const auto modes = vibration_modes(problem, 3);
  EXPECT_NEAR(modes[0].eigenvalue, 25 * std::pow(pi, 4), 1e-7 * modes[0].eigenvalue);
  EXPECT_NEAR(modes[2].eigenvalue, 64 * std::pow(pi, 4), 1e-7 * modes[2].eigenvalue);
  for (int k = 0; k <= 20; ++k) EXPECT_NEAR(modes[1].shape.value(0.5, k / 20.), 0, 1e-6);
  problem.supports.lines.clear();
  problem.supports.points = {{0.5, 0.5}};
  const auto point = vibration_modes(problem, 3);
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_NEAR(point[k].eigenvalue, 25 * std::pow(pi, 4), 1e-7 * point[k].eigenvalue);
  EXPECT_NEAR(point[2].shape.value(0.5, 0.5), 0, 1e-12);
}

// Cubics take the jump of the third derivative over a line of knots exactly. Half of a plate that is simply supported
// on three sides and clamped on the fourth moves like the symmetric modes of the whole over a line support.
TEST(Vibration, of_a_plate_over_a_line_is_that_of_its_clamped_half) {
  auto whole = plate(32, 3, Side::simply_supported());
  whole.supports.lines = {{{0.5, 0}, {0.5, 1}, 0.}};
  auto half = plate(16, 3, Side::simply_supported());
  half.region = {Interval(0, 0.5, 16), Interval(0, 1, 32)};
  half.sides.right = Side::clamped();
  const double known = vibration_modes(half, 1).front().eigenvalue;
  EXPECT_NEAR(vibration_modes(whole, 2)[1].eigenvalue, known, 1e-5 * known);
}

TEST(Vibration, keeps_the_rigid_motions_that_supports_leave) {
  auto problem = plate(24, 3, Side::free());
  problem.supports.points = {{0.25, 0.5}, {0.75, 0.5}};
  const auto modes = vibration_modes(problem, 2);
  EXPECT_EQ(modes[0].eigenvalue, 0);
  EXPECT_GT(modes[1].eigenvalue, 1);
  // ∫∫ (a (y - 1/2))² = 1
  EXPECT_NEAR(std::abs(modes[0].shape.value(0.1, 1)), std::sqrt(3.), 1e-12);
}

TEST(Vibration, shapes_are_orthonormal_and_their_largest_value_is_positive) {
  const auto modes = vibration_modes(membrane(32, 3, Side::fixed()), 6, 2.);
  constexpr int n = 128;
  for (const auto& a : modes) {
    double largest = 0, smallest = 0;
    for (const auto& b : modes) {
      double sum = 0;  // exact for products of sines
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const double x = (i + 0.5) / n, y = (j + 0.5) / n, value = a.shape.value(x, y);
          sum += 2 * value * b.shape.value(x, y) / (n * n);
          largest = std::max(largest, value);
          smallest = std::min(smallest, value);
        }
      EXPECT_NEAR(sum, &a == &b ? 1 : 0, 1e-6);
    }
    EXPECT_GE(largest, -smallest * (1 - 1e-3));
  }
}

TEST(Vibration, takes_no_more_iterations_on_finer_grids) {
  for (int cells : {32, 64, 128}) {
    const auto found = vibration(plate(cells, 3, Side::clamped()), 4);
    EXPECT_LE(found.iterations, 4) << cells;
    EXPECT_LE(found.cycles, 40) << cells;
    for (const auto& mode : found.modes) EXPECT_LE(mode.residual, 1e-10);
  }
}

TEST(Vibration, refuses_counts_and_densities_out_of_range) {
  const auto problem = membrane(8, 2, Side::fixed());  // 8 x 8 functions vanish on the sides
  const auto refusal = [&](int count, const Field& density) {
    return message_of<InvalidInput>([&] { vibration_modes(problem, count, density); });
  };
  EXPECT_EQ(refusal(0, 1.),
            "vibration_modes: expected a count from 1 to 8, an eighth of the number of unknowns, found 0");
  EXPECT_EQ(refusal(9, 1.),
            "vibration_modes: expected a count from 1 to 8, an eighth of the number of unknowns, found 9");
  EXPECT_EQ(vibration_modes(problem, 8).size(), 8u);
  EXPECT_EQ(refusal(1, 0.), "Mass: expected a density > 0, found 0");
  EXPECT_NE(
      refusal(1, Field([](double x, double) { return x - 0.5; })).find("expected a density > 0 everywhere, found -"),
      std::string::npos);
}

}  // namespace
}  // namespace batten
