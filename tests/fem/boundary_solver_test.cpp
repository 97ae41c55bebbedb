// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/boundary_solver.h>
#include <batten/fem/boundary_system.h>
#include <batten/fem/side_data.h>

#include "../support/laws.h"
#include "../support/manufactured.h"
#include "../support/message_of.h"
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace batten {
namespace {

using test::error_of, test::expect_orders, test::flat, test::Product, test::unit_square, test::wave;

constexpr double pi = std::numbers::pi;

Sides all(const Side& side) { return {side, side, side, side}; }

BoundaryProblem plate(int cells, int degree, const Side& side) {
  BoundaryProblem problem{KirchhoffPlate{}, unit_square(cells), degree, all(side), {}, {}};
  problem.loads.area = 1.;
  return problem;
}

BoundaryProblem membrane(int cells, int degree, const Side& side) {
  BoundaryProblem problem{Conduction{}, unit_square(cells), degree, all(side), {}, {}};
  problem.loads.area = 1.;
  return problem;
}

double sum(const std::array<double, 4>& values) { return std::accumulate(values.begin(), values.end(), 0.); }

// Classical numbers of plates, q a^4 / D and P a^2 / D with a = D = 1 [Timoshenko & Woinowsky-Krieger 1959], to the
// digits that series give.
TEST(ClampedPlate, under_uniform_load_has_the_known_deflection_moments_and_volume) {
  const auto result = solve_boundary_problem(plate(64, 5, Side::clamped()));
  const auto& w = result.solution;
  EXPECT_NEAR(w.value(0.5, 0.5), 0.00126531908748, 1e-10 * 0.00126531908748);
  EXPECT_NEAR(result.compliance, 3.89120077507e-4, 1e-9 * 3.9e-4);
  EXPECT_NEAR(-(w.derivative(0.5, 0.5, 2, 0) + 0.3 * w.derivative(0.5, 0.5, 0, 2)), 0.02290509, 1e-8);
  EXPECT_NEAR(-w.derivative(0, 0.5, 2, 0), -0.05133376, 1e-8);
  EXPECT_NEAR(sum(result.side_reactions), -1, 1e-8);
  EXPECT_LT(result.accuracy, 1e-10);
}

TEST(ClampedPlate, centre_error_of_bicubics_falls_as_stated) {
  const std::array limits = {3.3e-3, 1.4e-4, 8.5e-6, 5.2e-7, 3.1e-8};
  for (std::size_t k = 0; k < limits.size(); ++k) {
    const int cells = 4 << k;
    const auto w = solve_boundary_problem(plate(cells, 3, Side::clamped())).solution;
    EXPECT_LT(std::abs(w.value(0.5, 0.5) / 0.00126531908748 - 1), 1.05 * limits[k]) << cells << " elements";
  }
}

TEST(ClampedPlate, under_a_centre_point_load_deflects_as_known) {
  auto problem = plate(128, 3, Side::clamped());
  problem.loads = {};
  problem.loads.points = {{0.5, 0.5, 1}};
  EXPECT_NEAR(solve_boundary_problem(problem).solution.value(0.5, 0.5), 0.005612, 1e-6);
}

TEST(SimplySupportedPlate, has_the_known_deflections_and_moment) {
  auto problem = plate(64, 5, Side::simply_supported());
  const auto uniform = solve_boundary_problem(problem);
  const auto& w = uniform.solution;
  EXPECT_NEAR(w.value(0.5, 0.5), 0.00406235266067506, 4e-13);
  EXPECT_NEAR(-(w.derivative(0.5, 0.5, 2, 0) + 0.3 * w.derivative(0.5, 0.5, 0, 2)), 0.04788637963, 1e-9);
  problem.region = unit_square(256);
  problem.degree = 3;
  problem.loads = {};
  problem.loads.points = {{0.5, 0.5, 1}};
  EXPECT_NEAR(solve_boundary_problem(problem).solution.value(0.5, 0.5), 0.0116008397722, 1e-7);
}

// 64 / π^8 Σ 1 / (m² n² (m² + n²)²) over odd m, n (Navier's series for q = D = a = 1).
double compliance_of_simply_supported_square() {
  double sum = 0;
  for (int m = 1; m < 2000; m += 2)
    for (int n = 1; n < 2000; n += 2) sum += 1 / (1. * m * m * n * n * std::pow(1. * m * m + 1. * n * n, 2));
  return 64 / std::pow(pi, 8) * sum;
}

TEST(SimplySupportedPlate, of_a_million_unknowns_has_the_right_compliance) {
  const auto result = solve_boundary_problem(plate(1000, 3, Side::simply_supported()));
  EXPECT_NEAR(result.compliance / compliance_of_simply_supported_square(), 1, 1e-10);
  EXPECT_LT(result.accuracy, 1e-10);
}

TEST(Membrane, under_uniform_load_has_the_known_centre_and_volume) {
  for (int degree : {3, 4, 5}) {
    const auto result = solve_boundary_problem(membrane(64, degree, Side::fixed()));
    EXPECT_NEAR(result.solution.value(0.5, 0.5), 0.0736713532815, 2e-9);
    EXPECT_NEAR(result.compliance, 0.0351442537388, 1e-10);
    EXPECT_NEAR(sum(result.side_reactions), -1, 1e-8);
  }
}

constexpr std::array sides_of_plates = {"free", "fixed", "clamped", "symmetry"};

Side side_of(std::string_view name) {
  if (name == "fixed") return Side::fixed();
  if (name == "clamped") return Side::clamped();
  return name == "symmetry" ? Side::symmetry() : Side::free();
}

TEST(BoundarySystem, spaces_are_nested_and_operators_galerkin_for_every_pair_of_adjacent_sides) {
  for (const char* x : sides_of_plates)
    for (const char* y : sides_of_plates)
      for (int degree = 2; degree <= 5; ++degree) {
        SCOPED_TRACE(testing::Message() << x << " beside " << y << ", degree " << degree);
        BoundaryProblem problem{KirchhoffPlate{1.5, 0.25, 0.7, 0.4},
                                {Interval(0, 1, 33), Interval(0, 0.8, 24)},
                                degree,
                                {side_of(x), Side::free(), side_of(y), Side::clamped()},
                                {},
                                {}};
        const BoundarySystem constant(problem);
        const auto& h = constant.hierarchy();
        for (int k = 0; k + 1 < h.size(); ++k) {
          test::expect_symmetric(h[k].energy);
          test::expect_galerkin(h[k], h[k + 1]);
        }
        std::get<KirchhoffPlate>(problem.material).rigidity = Field([](double, double) { return 1.5; });
        const BoundarySystem assembled(problem);
        const auto v = test::random_vector(constant.multigrid().size(), 7);
        const auto a = constant.apply(v), b = assembled.apply(v);
        double largest = 0, error = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
          largest = std::max(largest, std::abs(a[i]));
          error = std::max(error, std::abs(a[i] - b[i]));
        }
        EXPECT_LT(error, 1e-12 * largest);
      }
}

TEST(BoundarySolver, converges_with_the_stated_orders_for_poisson_problems_and_every_kind_of_side) {
  const Product exact{wave(1, 2.3, 0.4), wave(1, 1.9, -0.3)};
  const auto value = Field([=](double x, double y) { return exact(x, y, 0, 0); });
  const auto slope = [=](double sign, bool in_x) {
    return Field([=](double x, double y) { return sign * (in_x ? exact(x, y, 1, 0) : exact(x, y, 0, 1)); });
  };
  for (int degree = 1; degree <= 5; ++degree) {
    BoundaryProblem problem{Conduction{1.7, 0.6}, unit_square(8), degree, {}, {}, {}};
    problem.loads.area =
        Field([=](double x, double y) { return -1.7 * exact.laplacian(x, y) + 0.6 * exact(x, y, 0, 0); });
    problem.sides = all(Side::fixed(value));
    expect_orders(problem, exact, 8);
    problem.sides = {Side::sloped(slope(-1, true)), Side::fixed(value), Side::sloped(slope(-1, false)),
                     Side::sloped(slope(1, false))};
    expect_orders(problem, exact, 8);
  }
}

TEST(BoundarySolver, converges_with_varying_coefficients) {
  const Product exact{wave(1, 2.3, 0.4), wave(1, 1.9, -0.3)};
  for (int degree = 1; degree <= 5; ++degree) {
    BoundaryProblem problem{Conduction{Field([](double x, double y) { return 1 + x * y; }), 0.},
                            unit_square(8),
                            degree,
                            all(Side::fixed(Field([=](double x, double y) { return exact(x, y, 0, 0); }))),
                            {},
                            {}};
    problem.loads.area = Field([=](double x, double y) {
      return -(1 + x * y) * exact.laplacian(x, y) - y * exact(x, y, 1, 0) - x * exact(x, y, 0, 1);
    });
    expect_orders(problem, exact, 8);
  }
}

TEST(BoundarySolver, converges_with_the_stated_orders_for_plates_and_every_kind_of_homogeneous_side) {
  const Product exact{flat, flat};
  for (int degree = 2; degree <= 5; ++degree)
    for (const char* name : sides_of_plates) {
      SCOPED_TRACE(name);
      BoundaryProblem problem{KirchhoffPlate{2., 0.3, 1.1, 0.7}, unit_square(8), degree, all(side_of(name)), {}, {}};
      problem.sides.top = Side::clamped();
      problem.loads.area = Field([=](double x, double y) {
        return 2 * exact.bilaplacian(x, y) - 0.7 * exact.laplacian(x, y) + 1.1 * exact(x, y, 0, 0);
      });
      expect_orders(problem, exact, degree == 5 ? 12 : 16);
    }
}

TEST(BoundarySolver, converges_for_clamped_plates_with_values_and_slopes_given) {
  const Product exact{wave(1, 2.3, 0.4), wave(1, 1.9, -0.3)};
  const auto side = [=](double nx, double ny) {
    return Side::clamped(Field([=](double x, double y) { return exact(x, y, 0, 0); }),
                         Field([=](double x, double y) { return nx * exact(x, y, 1, 0) + ny * exact(x, y, 0, 1); }));
  };
  for (int degree = 2; degree <= 5; ++degree) {
    BoundaryProblem problem{
        KirchhoffPlate{}, unit_square(8), degree, {side(-1, 0), side(1, 0), side(0, -1), side(0, 1)}, {}, {}};
    problem.loads.area = Field([=](double x, double y) { return exact.bilaplacian(x, y); });
    expect_orders(problem, exact, 8);
  }
}

TEST(BoundarySolver, takes_as_few_iterations_for_smooth_data_of_the_sides_as_for_loads) {
  const Product exact{wave(1, 2.3, 0.4), wave(1, 1.9, -0.3)};
  const auto value = Field([=](double x, double y) { return exact(x, y, 0, 0); });
  const auto outward = [=](double sign, bool in_x) {
    return Field([=](double x, double y) { return sign * (in_x ? exact(x, y, 1, 0) : exact(x, y, 0, 1)); });
  };
  for (const bool is_plate : {false, true}) {
    const auto loaded = is_plate ? plate(128, 3, Side::clamped()) : membrane(128, 3, Side::fixed());
    auto moved = loaded;
    moved.loads = {};
    moved.sides = all(Side::fixed(value));
    if (is_plate)
      moved.sides = {Side::clamped(value, outward(-1, true)), Side::clamped(value, outward(1, true)),
                     Side::clamped(value, outward(-1, false)), Side::clamped(value, outward(1, false))};
    EXPECT_LE(solve_boundary_problem(moved).iterations, solve_boundary_problem(loaded).iterations + 1);
  }
}

TEST(BoundarySolver, bends_a_free_plate_on_three_points_as_balance_asks) {
  auto problem = plate(48, 3, Side::free());
  problem.supports.points = {{0.2, 0.2, 0.5}, {0.8, 0.2, 0}, {0.5, 0.9, 0}};
  const auto result = solve_boundary_problem(problem);
  EXPECT_NEAR(result.solution.value(0.2, 0.2), 0.5, 1e-10);
  EXPECT_NEAR(result.solution.value(0.5, 0.9), 0, 1e-10);
  // forces and moments of three supports about the centre
  const auto& r = result.point_reactions;
  EXPECT_NEAR(r[0] + r[1] + r[2], -1, 1e-7);
  EXPECT_NEAR(-0.3 * r[0] + 0.3 * r[1], 0, 1e-7);
  EXPECT_NEAR(-0.3 * r[0] - 0.3 * r[1] + 0.4 * r[2], 0, 1e-7);
}

TEST(BoundarySolver, gives_a_plate_that_is_free_to_move_no_mean_and_no_tilt) {
  auto problem = plate(32, 3, Side::free());
  problem.loads.area = Field([](double x, double y) { return std::cos(2 * pi * x) * std::cos(4 * pi * y); });
  const auto result = solve_boundary_problem(problem);
  const auto& w = result.solution;
  double mean = 0, largest = 0;
  for (int j = 0; j < 64; ++j)
    for (int i = 0; i < 64; ++i) {
      const double value = w.value((i + 0.5) / 64, (j + 0.5) / 64);
      mean += value / 4096;
      largest = std::max(largest, std::abs(value));
    }
  EXPECT_LT(std::abs(mean), 1e-4 * largest);
  EXPECT_EQ(result.notes.size(), 1u);
}

TEST(BoundarySolver, holds_pegs_and_lines_of_membranes) {
  auto problem = membrane(100, 2, Side::fixed());
  problem.loads = {};
  problem.supports.points = {{0.3, 0.3, 1, 0.05}};
  problem.supports.lines = {{{0.6, 0.2}, {0.8, 0.9}, -1.}};
  const auto u = solve_boundary_problem(problem).solution;
  for (int k = 0; k < 40; ++k) {
    const double angle = 2 * pi * k / 40;
    EXPECT_NEAR(u.value(0.3 + 0.05 * std::cos(angle), 0.3 + 0.05 * std::sin(angle)), 1, 2e-2);
    EXPECT_NEAR(u.value(0.6 + 0.2 * k / 40, 0.2 + 0.7 * k / 40), -1, 1e-2);
  }
}

TEST(BoundarySolver, takes_a_couple_as_the_limit_of_two_forces) {
  constexpr double apart = 1e-3;
  auto by_couple = plate(16, 5, Side::clamped()), by_forces = by_couple;
  by_couple.loads.area = by_forces.loads.area = 0.;
  by_couple.loads.couples = {{0.3, 0.6, 2, -1}};
  by_forces.loads.points = {{0.3 + apart, 0.6, 1 / apart},
                            {0.3 - apart, 0.6, -1 / apart},
                            {0.3, 0.6 + apart, -0.5 / apart},
                            {0.3, 0.6 - apart, 0.5 / apart}};
  const auto couple = solve_boundary_problem(by_couple), forces = solve_boundary_problem(by_forces);
  for (const auto& [x, y] : {std::pair{0.5, 0.5}, {0.7, 0.2}, {0.2, 0.8}})
    EXPECT_NEAR(couple.solution.value(x, y), forces.solution.value(x, y), 1e-5) << x << ' ' << y;
  EXPECT_NEAR(couple.compliance,
              2 * couple.solution.derivative(0.3, 0.6, 1, 0) - couple.solution.derivative(0.3, 0.6, 0, 1), 1e-10);
}

TEST(BoundarySolver, takes_couples_everywhere_as_the_load_of_their_divergence) {
  auto by_couples = plate(12, 3, Side::clamped()), by_load = by_couples;
  by_couples.loads.area = 0.;
  by_couples.loads.area_mx = Field([](double x, double y) { return x * x * y; });
  by_couples.loads.area_my = 5;
  by_load.loads.area = Field([](double x, double y) { return -2 * x * y; });
  const auto a = solve_boundary_problem(by_couples).solution, b = solve_boundary_problem(by_load).solution;
  for (const auto& [x, y] : {std::pair{0.5, 0.5}, {0.7, 0.2}, {0.2, 0.8}})
    EXPECT_NEAR(a.value(x, y), b.value(x, y), 1e-12 * std::abs(b.value(x, y))) << x << ' ' << y;
}

TEST(BoundarySolver, keeps_values_at_a_corner_where_slopes_ask_for_others) {
  for (const int degree : {2, 3, 5}) {
    auto problem = plate(12, degree, Side::clamped());
    problem.sides.top = Side::clamped(0., 1.);
    const auto w = solve_boundary_problem(problem).solution;
    for (const double s : {0., 0.02, 0.5, 0.93, 0.99, 1.}) {
      EXPECT_NEAR(w.value(s, 1), 0, 1e-16) << degree;
      EXPECT_NEAR(w.value(0, s), 0, 1e-16) << degree;
    }
    EXPECT_NEAR(w.derivative(0.5, 1, 0, 1), 1, 1e-2) << degree;
  }
}

TEST(BoundarySolver, averages_corner_values_that_differ_and_says_so) {
  auto problem = membrane(16, 2, Side::fixed());
  problem.sides.left = Side::fixed(1.);
  const auto result = solve_boundary_problem(problem);
  EXPECT_EQ(result.notes.size(), 2u);
  EXPECT_NEAR(result.solution.value(0, 0), 0.5, 1e-12);
  EXPECT_NEAR(result.solution.value(0, 0.5), 1, 1e-12);
}

/// Iterations to 1e-10 on a clamped or fixed unit square whose coefficient is a checkerboard of 8 x 8 fields.
int checkerboard_iterations(bool is_plate, int cells, int degree, double contrast) {
  const Field field(
      [=](double x, double y) { return (static_cast<int>(8 * x) + static_cast<int>(8 * y)) % 2 == 0 ? 1. : contrast; });
  BoundaryProblem problem = is_plate ? plate(cells, degree, Side::clamped()) : membrane(cells, degree, Side::fixed());
  if (is_plate)
    problem.material = KirchhoffPlate{field};
  else
    problem.material = Conduction{field};
  return solve_boundary_problem(problem).iterations;
}

TEST(BoundarySolver, needs_few_iterations_at_every_size_for_a_checkerboard_of_contrast_a_thousand) {
  for (const bool is_plate : {false, true})
    for (int degree = is_plate ? 2 : 1; degree <= 3; ++degree) {
      const int even = checkerboard_iterations(is_plate, 64, degree, 1);
      const int small = checkerboard_iterations(is_plate, 64, degree, 1000);
      const int large = checkerboard_iterations(is_plate, 256, degree, 1000);
      EXPECT_LE(small, (is_plate ? 4 : 3) * even) << "degree " << degree;
      EXPECT_LE(large, small + 1) << "degree " << degree;
    }
}

TEST(BoundarySolver, keeps_the_digits_of_stored_matrices_on_fine_grids) {
  const Field field(
      [](double x, double y) { return (static_cast<int>(8 * x) + static_cast<int>(8 * y)) % 2 ? 1e3 : 1.; });
  auto problem = plate(256, 3, Side::clamped());
  problem.material = KirchhoffPlate{field};
  const auto jumps = solve_boundary_problem(problem, {.limits = {.accuracy = 1e-11}});
  EXPECT_LE(jumps.accuracy, 1e-11);
  EXPECT_NEAR(jumps.energy / jumps.compliance, 1, 5e-12);  // a(u, u) = b·u; sums of entries leave 1e-10
  problem = plate(256, 3, Side::simply_supported());
  const double constant = solve_boundary_problem(problem).compliance;
  problem.material = KirchhoffPlate{Field([](double, double) { return 1.; })};
  EXPECT_NEAR(solve_boundary_problem(problem).compliance / constant, 1, 1e-11);
}

TEST(BoundarySolver, reaches_the_asked_accuracy_for_free_plates_of_high_degree) {
  for (int degree : {4, 5}) {
    auto problem = plate(64, degree, Side::free());
    std::get<KirchhoffPlate>(problem.material).foundation = 1.;
    problem.loads.area = Field([](double x, double y) { return x * y + (x > 0.3 ? 1 : 0); });
    const auto result = solve_boundary_problem(problem);
    EXPECT_LE(result.accuracy, 1e-10) << degree;
    EXPECT_LE(result.iterations, 30) << degree;
  }
}

std::string refusal(const BoundaryProblem& problem) {
  return message_of<InvalidInput>([&] { solve_boundary_problem(problem); });
}

TEST(BoundarySolver, refuses_loads_that_nothing_balances_and_says_by_how_much) {
  EXPECT_EQ(
      refusal(membrane(8, 2, Side::free())),
      "solve_boundary_problem: expected loads and fluxes that add up to 0, since no side or support fixes a value; "
      "found a sum of 1");
  auto problem = plate(8, 3, Side::free());
  problem.loads.area = Field([](double x, double) { return x - 0.5; });
  EXPECT_NE(refusal(problem).find("moments about the centre of 0.0833333 (in x)"), std::string::npos)
      << refusal(problem);
}

TEST(BoundarySolver, refuses_bare_points_in_membranes_and_supports_that_contradict_each_other) {
  auto problem = membrane(8, 2, Side::fixed());
  problem.supports.points = {{0.5, 0.5, 1}};
  EXPECT_NE(refusal(problem).find("expected a radius > 0 of the support at (0.5, 0.5)"), std::string::npos);
  auto other = plate(8, 3, Side::clamped());
  other.supports.points = {{0.5, 0.5, 1}, {0.5, 0.5, 2}};
  EXPECT_NE(refusal(other).find("supports with 1 and 2 at (0.5, 0.5)"), std::string::npos);
  other.supports.points = {{0.5, 1.5, 1}};
  EXPECT_NE(refusal(other).find("within the rectangle, found one at (0.5, 1.5)"), std::string::npos);
}

TEST(BoundarySolver, refuses_coefficients_and_loads_out_of_range_and_says_where) {
  auto problem = membrane(8, 2, Side::fixed());
  problem.material = Conduction{Field([](double x, double) { return 0.5 - x; }), 0.};
  EXPECT_NE(refusal(problem).find("expected k > 0 everywhere, found -"), std::string::npos) << refusal(problem);
  problem.material = Conduction{};
  problem.loads.area = Field([](double x, double) { return std::sqrt(x - 0.5); });
  EXPECT_NE(refusal(problem).find("expected a finite load, found -nan at (0.0"), std::string::npos) << refusal(problem);
  problem.loads.area = 0;
  problem.loads.couples = {{0.5, 0.5, 1, 0}};
  EXPECT_NE(refusal(problem).find("couples at points of plates only"), std::string::npos) << refusal(problem);
}

}  // namespace
}  // namespace batten
