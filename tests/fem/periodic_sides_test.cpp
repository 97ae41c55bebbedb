// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/boundary_solver.h>
#include <batten/fem/boundary_system.h>
#include <batten/fem/time_stepping.h>
#include <batten/fem/vibration.h>

#include "../support/laws.h"
#include "../support/manufactured.h"
#include "../support/message_of.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace batten {
namespace {

using test::expect_orders, test::flat, test::Product, test::unit_square, test::wave;

constexpr double pi = std::numbers::pi;

Sides closed_in_x(const Side& other) { return {Side::repeated(), Side::repeated(), other, other}; }
Sides closed_in_y(const Side& other) { return {other, other, Side::repeated(), Side::repeated()}; }
Sides closed() { return {Side::repeated(), Side::repeated(), Side::repeated(), Side::repeated()}; }

BoundaryProblem membrane(int cells, int degree, const Sides& sides) {
  return {Conduction{}, unit_square(cells), degree, sides, {}, {}};
}

BoundaryProblem plate(int cells, int degree, const Sides& sides) {
  return {KirchhoffPlate{}, unit_square(cells), degree, sides, {}, {}};
}

/// Random coefficients of a periodic spline, or loads with nothing at images.
std::vector<double> random_spline(const SplineSpace& space, unsigned seed) {
  auto v = test::random_vector(space.size(), seed);
  for (int j = 0; j < space.y.size(); ++j)
    for (int i = 0; i < space.x.size(); ++i)
      if (!space.is_periodic() && space.is_removed(i, j)) v[static_cast<std::size_t>(j * space.x.size() + i)] = 0;
  fill_images(space, v);
  return v;
}

double largest(std::span<const double> v) {
  double result = 0;
  for (double x : v) result = std::max(result, std::abs(x));
  return result;
}

std::vector<double> difference(std::vector<double> a, std::span<const double> b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

void expect_galerkin_around(const Hierarchy& h, int k) {
  const auto c = random_spline(h[k + 1].space, 3);
  const auto fine = test::applied(h[k].energy, test::applied(*h[k].refinement, c));
  std::vector<double> product(h[k + 1].space.size());
  h.restrict_from(k, fine, product);
  const auto exact = test::applied(h[k + 1].energy, c);
  EXPECT_LT(largest(difference(product, exact)), 2e-12 * largest(exact)) << "level " << k;
}

TEST(PeriodicSides, leave_spaces_nested_and_operators_galerkin_symmetric_and_equal_to_assembled_ones) {
  for (int degree = 2; degree <= 5; ++degree)
    for (const Sides& sides : {closed_in_x(Side::clamped()), closed_in_x(Side::free()), closed_in_y(Side::fixed()),
                               closed_in_y(Side::symmetry()), closed()}) {
      SCOPED_TRACE(testing::Message() << "degree " << degree);
      auto problem = plate(48, degree, sides);
      problem.material = KirchhoffPlate{1.5, 0.25, 0.7, 0.4};
      const BoundarySystem constant(problem);
      const auto& h = constant.hierarchy();
      EXPECT_GE(h.size(), 3);
      for (int k = 0; k + 1 < h.size(); ++k) expect_galerkin_around(h, k);
      std::get<KirchhoffPlate>(problem.material).rigidity = Field([](double, double) { return 1.5; });
      const BoundarySystem assembled(problem);
      for (int k = 0; k + 1 < h.size(); ++k) expect_galerkin_around(assembled.hierarchy(), k);
      const auto v = random_spline(constant.space(), 7), u = random_spline(constant.space(), 8);
      const auto av = constant.apply(v), au = constant.apply(u);
      EXPECT_LT(largest(difference(av, assembled.apply(v))), 1e-12 * largest(av));
      EXPECT_NEAR(test::dot(u, av), test::dot(v, au), 1e-12 * std::sqrt(test::dot(u, au) * test::dot(v, av)));
      // the same through all splines
      const auto there = constant.restricted(constant.apply_whole(constant.whole(v)));
      EXPECT_LT(largest(difference(there, av)), 1e-10 * largest(av));
    }
}

TEST(PeriodicSides, let_poisson_problems_converge_with_the_stated_orders) {
  const Product strip{wave(1, 2 * pi, 0.4), wave(1, 1.9, -0.3)}, torus{wave(1, 2 * pi, 0.4), wave(1, 2 * pi, 1)};
  const auto load = [](const Product& u) {
    return Field([=](double x, double y) { return -1.7 * u.laplacian(x, y) + 0.6 * u(x, y, 0, 0); });
  };
  for (int degree = 1; degree <= 5; ++degree) {
    auto problem =
        membrane(12, degree, closed_in_x(Side::fixed(Field([=](double x, double y) { return strip(x, y, 0, 0); }))));
    problem.material = Conduction{1.7, 0.6};
    problem.loads.area = load(strip);
    expect_orders(problem, strip, 12);
    problem.sides = closed();
    problem.loads.area = load(torus);
    expect_orders(problem, torus, 12);
  }
}

TEST(PeriodicSides, let_plates_converge_with_the_stated_orders) {
  const Product strip{flat, wave(1, 2 * pi, 0.4)}, torus{wave(1, 2 * pi, 0.4), wave(1, 2 * pi, 1)};
  const auto load = [](const Product& u) {
    return Field(
        [=](double x, double y) { return 2 * u.bilaplacian(x, y) - 0.7 * u.laplacian(x, y) + 1.1 * u(x, y, 0, 0); });
  };
  for (int degree = 2; degree <= 5; ++degree) {
    auto problem = plate(16, degree, closed_in_y(Side::clamped()));
    problem.material = KirchhoffPlate{2., 0.3, 1.1, 0.7};
    problem.loads.area = load(strip);
    expect_orders(problem, strip, 16);
    problem.sides = closed();
    problem.loads.area = load(torus);
    expect_orders(problem, torus, 16);
  }
}

TEST(PeriodicSides, let_varying_coefficients_vary_around_the_seam) {
  const Product u{wave(1, 2 * pi, 0.4), wave(1, 1.9, -0.3)};
  const auto k = [](double x) { return 1 + 0.5 * std::cos(2 * pi * x); };
  for (int degree : {1, 3, 5}) {
    auto problem =
        membrane(12, degree, closed_in_x(Side::fixed(Field([=](double x, double y) { return u(x, y, 0, 0); }))));
    problem.material = Conduction{Field([=](double x, double) { return k(x); }), 0.};
    problem.loads.area = Field(
        [=](double x, double y) { return -k(x) * u.laplacian(x, y) + pi * std::sin(2 * pi * x) * u(x, y, 1, 0); });
    expect_orders(problem, u, 12);
  }
}

/// The solution for a load and supports that are moved by `shift` cells of 64 around the circle.
Solution moved(int shift, bool along_x) {
  const double s = shift / 64.;
  auto problem = plate(64, 3, along_x ? closed_in_x(Side::fixed()) : closed_in_y(Side::fixed()));
  const auto around = [](double t) { return t - std::floor(t); };
  const auto place = [=](double t, double across) {
    return along_x ? std::array{around(t + s), across} : std::array{across, around(t + s)};
  };
  const auto load = place(0.53, 0.3), post = place(0.26, 0.6);
  problem.loads.points = {{load[0], load[1], 1}};
  problem.supports.points = {{post[0], post[1], 0.001, 0}};
  return solve_boundary_problem(problem).solution;
}

TEST(PeriodicSides, do_not_show_where_the_seam_is) {
  for (const bool along_x : {true, false}) {
    const auto here = moved(0, along_x), there = moved(31, along_x);
    double error = 0, size = 0;
    for (int k = 0; k < 64; ++k)
      for (double across : {0.2, 0.5, 0.77}) {
        const double t = (k + 0.3) / 64, u = std::fmod(t + 31. / 64, 1);
        const double a = along_x ? here.value(t, across) : here.value(across, t);
        const double b = along_x ? there.value(u, across) : there.value(across, u);
        error = std::max(error, std::abs(a - b));
        size = std::max(size, std::abs(a));
      }
    EXPECT_LT(error, 1e-8 * size);
  }
}

TEST(PeriodicSides, take_few_iterations_at_every_size) {
  for (const bool is_plate : {false, true})
    for (int cells : {64, 96, 256}) {
      auto problem = is_plate ? plate(cells, 3, closed_in_y(Side::clamped())) : membrane(cells, 3, closed());
      problem.loads.area =
          Field([](double x, double y) { return std::cos(2 * pi * x) * std::exp(std::cos(2 * pi * y)); });
      const auto result = solve_boundary_problem(problem);
      EXPECT_LE(result.iterations, 9) << cells;
      EXPECT_LT(result.accuracy, 1e-10);
    }
}

TEST(PeriodicSides, leave_the_mean_of_a_closed_membrane_free) {
  auto problem = membrane(32, 3, closed());
  problem.loads.area = Field([](double x, double) { return 4 * pi * pi * std::sin(2 * pi * x); });
  const auto result = solve_boundary_problem(problem);
  EXPECT_NEAR(result.solution.value(0.25, 0.6), 1, 1e-5);
  EXPECT_NEAR(result.solution.value(0, 0.1), 0, 1e-9);
  problem.loads.area = 1.;
  EXPECT_THAT(message_of<InvalidInput>([&] { solve_boundary_problem(problem); }),
              testing::HasSubstr("found a sum of 1"));
}

TEST(PeriodicSides, give_the_vibrations_of_a_torus_and_of_a_ring_of_plates) {
  const auto torus = vibration_modes(membrane(32, 4, closed()), 9);
  EXPECT_EQ(torus[0].eigenvalue, 0);
  for (std::size_t k = 1; k < 9; ++k) EXPECT_NEAR(torus[k].eigenvalue / (4 * pi * pi), k < 5 ? 1 : 2, 1e-6) << k;
  // simply supported in y: (4 m² + n²)² π⁴, twice for m > 0
  const auto ring = vibration_modes(plate(32, 4, closed_in_x(Side::fixed())), 6);
  const std::array<double, 6> expected = {1, 16, 25, 25, 64, 64};
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(ring[k].eigenvalue / std::pow(pi, 4), expected[k], 2e-5 * expected[k]);
}

TEST(PeriodicSides, let_heat_flow_across_the_seam) {
  auto problem = membrane(24, 3, closed());
  const Motion motion{.end = 0.01, .step = 0.0005, .initial = Field([](double x, double y) {
                                                     return std::cos(2 * pi * x) * std::cos(2 * pi * y) + 0.5;
                                                   })};
  double first = 0, last = 0;
  march(problem, motion, [&](double time, const Solution& state) {
    (time == 0 ? first : last) = state.value(0, 1);
    EXPECT_NEAR(state.value(0, 0.3), state.value(1, 0.3), 1e-12);
  });
  EXPECT_NEAR(first, 1.5, 1e-4);
  EXPECT_NEAR(last, 0.5 + std::exp(-8 * pi * pi * 0.01), 2e-4);
}

TEST(PeriodicSides, say_where_data_of_other_sides_do_not_close) {
  auto problem = membrane(16, 3, closed_in_x(Side::fixed(Field([](double x, double) { return x; }))));
  const auto result = solve_boundary_problem(problem);
  ASSERT_EQ(result.notes.size(), 2u);
  EXPECT_THAT(result.notes[0], testing::HasSubstr("is 0 at one periodic side and 1 at the other"));
  problem.sides = closed_in_x(Side::fixed(Field([](double x, double) { return std::sin(2 * pi * x); })));
  EXPECT_TRUE(solve_boundary_problem(problem).notes.empty());
}

TEST(PeriodicSides, refuse_lonely_ones_data_and_grids_that_cannot_be_halved) {
  const auto refusal = [](const BoundaryProblem& problem) {
    return message_of<InvalidInput>([&] { solve_boundary_problem(problem); });
  };
  auto problem = membrane(16, 2, closed_in_x(Side::fixed()));
  problem.sides.left = Side::fixed();
  EXPECT_EQ(refusal(problem),
            "side_conditions: expected opposite sides to be periodic together, found one that is not");
  problem.sides.left = Side::repeated();
  problem.sides.right.value = Field(1.);
  EXPECT_EQ(refusal(problem), "side_conditions: expected nothing prescribed on periodic sides, found data");
  EXPECT_THAT(refusal(membrane(4, 3, closed_in_x(Side::fixed()))), testing::HasSubstr("at least 7 equal cells"));
  EXPECT_THAT(refusal(membrane(317, 3, closed())), testing::HasSubstr("can be halved often, as 256 can; found"));
}

}  // namespace
}  // namespace batten
