// SPDX-License-Identifier: MIT
#include <batten/bases/gauss_rule.h>
#include <batten/domains/errors.h>
#include <batten/flows/stokes.h>
#include <batten/flows/stream_extremes.h>

#include "../support/message_of.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace batten {
namespace {

using testing::HasSubstr;
using Velocity = FlowField::Velocity;
using Flow = std::function<Velocity(double, double)>;

StokesProblem still_box(int cells, int degree) {
  return {.region = {Interval(0, 1, cells), Interval(0, 1, cells)}, .degree = degree};
}

StokesSide following(const Flow& flow) {
  return StokesSide::moving(Field([flow](double x, double y) { return flow(x, y).u; }),
                            Field([flow](double x, double y) { return flow(x, y).v; }));
}

StokesProblem box_following(const Flow& flow, const Rectangle& region, int degree) {
  StokesProblem problem{.region = region, .degree = degree};
  problem.left = problem.right = problem.bottom = problem.top = following(flow);
  return problem;
}

/// Root mean square of |v - flow| over the cells.
double velocity_error(const FlowField& field, const Flow& flow) {
  const GaussRule rule = gauss_rule(field.degree() + 2);
  const auto &ix = field.region().x, &iy = field.region().y;
  double sum = 0;
  for (int j = 0; j < iy.cells(); ++j)
    for (int i = 0; i < ix.cells(); ++i)
      for (std::size_t q = 0; q < rule.place.size(); ++q)
        for (std::size_t p = 0; p < rule.place.size(); ++p) {
          const double x = std::lerp(ix.coordinate(i), ix.coordinate(i + 1), rule.place[p]);
          const double y = std::lerp(iy.coordinate(j), iy.coordinate(j + 1), rule.place[q]);
          const auto found = field.velocity(x, y), asked = flow(x, y);
          sum += rule.weight[p] * rule.weight[q] * (std::pow(found.u - asked.u, 2) + std::pow(found.v - asked.v, 2));
        }
  return std::sqrt(sum / ix.cells() / iy.cells());
}

TEST(Stokes, gives_channel_flow_exactly) {
  const Flow poiseuille = [](double, double y) { return Velocity{4 * y * (1 - y), 0}; };
  const Flow couette = [](double, double y) { return Velocity{y, 0}; };
  const Rectangle channel{Interval(-1, 2, 24), Interval(0, 1, 10)};
  for (const int degree : {3, 4, 5}) {
    const auto poiseuille_result = solve_stokes(box_following(poiseuille, channel, degree));
    EXPECT_LT(velocity_error(poiseuille_result.field, poiseuille), 1e-11) << degree;
    EXPECT_NEAR(poiseuille_result.inflow, 2. / 3, 1e-14);
    EXPECT_NEAR(poiseuille_result.dissipation, 3 * 16. / 3, 1e-10);  // ∫∫ u_y² = 3 ∫ (4 - 8 y)²
    EXPECT_LT(poiseuille_result.largest_divergence, 1e-8);
    EXPECT_LT(velocity_error(solve_stokes(box_following(couette, channel, degree)).field, couette), 1e-11) << degree;
  }
}

TEST(Stokes, gives_half_of_a_channel_below_a_line_of_symmetry) {
  const Flow poiseuille = [](double, double y) { return Velocity{4 * y * (1 - y), 0}; };
  StokesProblem problem = box_following(poiseuille, {Interval(0, 1, 16), Interval(0, 0.5, 8)}, 3);
  problem.top = StokesSide::symmetry();
  const FlowField field = solve_stokes(problem).field;
  EXPECT_LT(velocity_error(field, poiseuille), 1e-11);
  EXPECT_NEAR(field.stream_function(0.3, 0.5) - field.stream_function(0.3, 0), 1. / 3, 1e-13);
}

TEST(Stokes, lets_a_rigid_rotation_pass_a_free_side) {
  const Flow rotation = [](double x, double y) { return Velocity{y, -x}; };
  for (const int free : {0, 1, 2, 3}) {
    StokesProblem problem = box_following(rotation, {Interval(-1, 2, 12), Interval(1, 2, 8)}, 3);
    (free == 0   ? problem.left
     : free == 1 ? problem.right
     : free == 2 ? problem.bottom
                 : problem.top) = StokesSide::free();
    const auto result = solve_stokes(problem);
    EXPECT_LT(velocity_error(result.field, rotation), 1e-9) << free;
    EXPECT_NEAR(result.dissipation, 0, 1e-10) << free;
  }
}

/// p and its derivatives at t, its coefficients from the constant on.
double polynomial(const std::vector<double>& p, double t, int order) {
  double sum = 0;
  for (std::size_t k = p.size(); k-- > static_cast<std::size_t>(order);) {
    double c = p[k];
    for (int r = 0; r < order; ++r) c *= static_cast<double>(k) - r;
    sum = sum * t + c;
  }
  return sum;
}

/// v = rot of a(x) b(y), and the force -μ Δv for it, with no pressure.
struct Manufactured {
  std::vector<double> a, b;
  double mu;

  double psi(double x, double y, int i, int j) const { return polynomial(a, x, i) * polynomial(b, y, j); }
  Velocity velocity(double x, double y) const { return {psi(x, y, 0, 1), -psi(x, y, 1, 0)}; }
  double force_x(double x, double y) const { return -mu * (psi(x, y, 2, 1) + psi(x, y, 0, 3)); }
  double force_y(double x, double y) const { return mu * (psi(x, y, 3, 0) + psi(x, y, 1, 2)); }

  StokesProblem problem(int cells, int degree) const {
    StokesProblem problem = still_box(cells, degree);
    problem.viscosity = mu;
    problem.force_x = Field([*this](double x, double y) { return force_x(x, y); });
    problem.force_y = Field([*this](double x, double y) { return force_y(x, y); });
    return problem;
  }
  double error(const StokesProblem& problem) const {
    return velocity_error(solve_stokes(problem).field, [*this](double x, double y) { return velocity(x, y); });
  }
};

const std::vector<double> bump = {0, 0, 1, -2, 1};  // t² (1 - t)²

TEST(Stokes, converges_to_a_polynomial_that_the_splines_hold_from_degree_4_on) {
  const Manufactured flow{bump, bump, 2.5};
  EXPECT_NEAR(std::log2(flow.error(flow.problem(8, 3)) / flow.error(flow.problem(16, 3))), 3, 0.05);
  for (const int degree : {4, 5}) EXPECT_LT(flow.error(flow.problem(8, degree)), 1e-15) << degree;
}

TEST(Stokes, has_an_error_of_the_order_of_the_degree) {
  const Manufactured flow{
      {0, 0, 1, -1, 0, 0, -1, 1}, {0, 0, 1, -2, 0, 2, -1}, 1};  // t² (1 - t - t⁴ + t⁵), t² (1 - t)² (1 - t²)
  for (const int degree : {3, 4, 5}) {
    StokesProblem coarse = flow.problem(16, degree), fine = flow.problem(32, degree);
    for (StokesProblem* const p : {&coarse, &fine}) {
      const Flow sides = [flow](double x, double y) { return flow.velocity(x, y); };
      p->left = p->right = p->bottom = p->top = following(sides);
    }
    EXPECT_NEAR(std::log2(flow.error(coarse) / flow.error(fine)), degree, 0.15) << degree;
  }
}

TEST(Stokes, has_no_stress_on_a_free_side) {
  // All derivatives of (1 - x)⁴ x² up to the third vanish at x = 1, so that there is neither stress nor pressure.
  const Manufactured flow{{0, 0, 1, -4, 6, -4, 1}, bump, 1};
  StokesProblem problem = flow.problem(16, 5);
  problem.right = StokesSide::free();
  const double coarse = flow.error(problem);
  problem = flow.problem(32, 5);
  problem.right = StokesSide::free();
  const double fine = flow.error(problem);
  EXPECT_LT(fine, 1e-8);
  EXPECT_NEAR(std::log2(coarse / fine), 5, 0.3);
}

TEST(Stokes, rests_under_a_force_that_is_a_gradient) {
  StokesProblem problem = still_box(16, 3);
  problem.force_x = Field([](double x, double y) { return 2000 * x * y; });
  problem.force_y = Field([](double x, double y) { return 1000 * (x * x - 3 * y * y); });
  const FlowField field = solve_stokes(problem).field;
  EXPECT_LT(velocity_error(field, [](double, double) { return Velocity{}; }), 1e-12);
}

TEST(Stokes, gives_the_flow_of_a_force_at_a_point) {
  // The Stokeslet of the plane: v = (-log r F + (F·r) r / r²) / (4 π μ).
  const double mu = 3, fx = 2, fy = -1;
  const Flow stokeslet = [=](double x, double y) {
    const double dx = x - 0.52, dy = y - 0.46, r2 = dx * dx + dy * dy;
    const double along = (fx * dx + fy * dy) / r2, log_r = std::log(r2) / 2;
    const double factor = 1 / (4 * std::numbers::pi * mu);
    return Velocity{factor * (along * dx - log_r * fx), factor * (along * dy - log_r * fy)};
  };
  StokesProblem problem = box_following(stokeslet, {Interval(0, 1, 64), Interval(0, 1, 64)}, 3);
  problem.viscosity = mu;
  problem.point_forces = {{0.52, 0.46, fx, fy}};
  const FlowField field = solve_stokes(problem).field;
  for (const auto& [x, y] : {std::pair{0.2, 0.2}, {0.8, 0.5}, {0.5, 0.75}, {0.3, 0.6}}) {
    EXPECT_NEAR(field.velocity(x, y).u, stokeslet(x, y).u, 1e-4) << x << ' ' << y;
    EXPECT_NEAR(field.velocity(x, y).v, stokeslet(x, y).v, 1e-4) << x << ' ' << y;
  }
}

TEST(Stokes, has_a_velocity_at_a_force_that_grows_with_the_logarithm_of_the_cells) {
  // The scale of the Stokeslet's -F log r / (4 π μ) is the cell.
  const auto velocity = [](int cells) {
    StokesProblem problem = still_box(cells, 3);
    problem.viscosity = 2;
    problem.point_forces = {{0.5, 0.5, 3, 0}};
    return solve_stokes(problem).field.velocity(0.5, 0.5).u;
  };
  EXPECT_NEAR(velocity(64) - velocity(32), 3 * std::log(2.) / (4 * std::numbers::pi * 2), 1e-5);
}

TEST(Stokes, loses_the_power_of_its_forces) {
  StokesProblem problem = still_box(24, 3);
  problem.viscosity = 0.5;
  problem.point_forces = {{0.3, 0.6, 1, 2}};
  problem.force_x = Field([](double, double y) { return std::sin(3 * y); });
  const auto result = solve_stokes(problem);
  EXPECT_GT(result.power, 0);
  EXPECT_NEAR(result.dissipation, result.power, 1e-9 * result.power);
  EXPECT_EQ(result.inflow, 0);
}

TEST(Stokes, gives_the_lid_driven_cavity) {
  StokesProblem problem = still_box(128, 4);
  problem.top = StokesSide::moving(1., 0.);
  const auto result = solve_stokes(problem);
  const FlowField& field = result.field;
  constexpr double tolerance = 1e-6;
  const auto centre = stream_extremes(field).least;
  EXPECT_NEAR(centre.value, -0.10007626642, tolerance);
  EXPECT_NEAR(centre.x, 0.5, 1e-9);
  EXPECT_NEAR(centre.y, 0.76502654356, tolerance);
  EXPECT_NEAR(field.stream_function(0.5, 0.5), -0.0589511555922, tolerance);
  EXPECT_NEAR(field.velocity(0.5, 0.5).u, -0.2051917128, tolerance);
  for (const auto& [y, u] :
       {std::pair{0.1, -0.0577765287}, {0.25, -0.1225955546}, {0.75, -0.0324436864}, {0.9, 0.4659722992}})
    EXPECT_NEAR(field.velocity(0.5, y).u, u, tolerance) << y;
  EXPECT_NEAR(field.velocity(0.1, 0.5).v, 0.1356660479, tolerance);
  EXPECT_NEAR(field.velocity(0.25, 0.5).v, 0.1788521031, tolerance);
  EXPECT_TRUE(result.notes.empty());
}

TEST(Stokes, keeps_the_velocities_of_walls_beside_a_lid) {
  StokesProblem problem = still_box(64, 3);
  problem.top = StokesSide::moving(1., 0.);
  const FlowField field = solve_stokes(problem).field;
  for (const double s : {0.1, 0.5, 0.9, 0.97, 0.995, 1.}) {
    EXPECT_NEAR(field.stream_function(0, s), 0, 1e-17);
    EXPECT_NEAR(field.stream_function(s, 1), 0, 1e-17);
  }
  // The lid is met in L2, and what its ends miss falls by 0.535, a root of the mass of cubics, in each of 32 cells.
  EXPECT_NEAR(field.velocity(0.5, 1).u, 1, std::pow(0.536, 32));
}

TEST(Stokes, refuses_a_net_inflow) {
  StokesProblem problem = still_box(8, 3);
  problem.left = StokesSide::moving(Field([](double, double y) { return 6 * y * (1 - y); }), 0.);
  problem.right = StokesSide::moving(0.75, 0.);
  EXPECT_THAT(
      message_of<InvalidInput>([&] { stream_function_problem(problem); }),
      HasSubstr("found a net inflow of 0.25 (in 1, out 0.75); at most 1e-09 of their mean, 8.75e-10, is taken"));
  problem.right = StokesSide::moving(1.25, 0.);
  EXPECT_THAT(message_of<InvalidInput>([&] { stream_function_problem(problem); }), HasSubstr("a net outflow of 0.25"));
  problem.right = StokesSide::moving(1 + 1e-10, 0.);
  EXPECT_NO_THROW(stream_function_problem(problem));
  problem.right = StokesSide::free();
  EXPECT_NEAR(solve_stokes(problem).net_inflow, 1, 1e-14);
}

TEST(Stokes, refuses_what_is_no_flow) {
  StokesProblem problem = still_box(8, 3);
  problem.viscosity = 0;
  EXPECT_THAT(message_of<InvalidInput>([&] { solve_stokes(problem); }), HasSubstr("viscosity > 0, found 0"));
  problem.viscosity = 1;
  problem.point_forces = {{1.5, 0, 1, 1}};
  EXPECT_THAT(message_of<InvalidInput>([&] { solve_stokes(problem); }), HasSubstr("found one at (1.5, 0)"));
  problem.point_forces = {{0.5, 0, std::nan(""), 1}};
  EXPECT_THAT(message_of<InvalidInput>([&] { solve_stokes(problem); }), HasSubstr("expected finite forces"));
  problem.point_forces.clear();
  problem.left = problem.top = StokesSide::free();
  EXPECT_THAT(message_of<InvalidInput>([&] { solve_stokes(problem); }), HasSubstr("at most one free side"));
}

}  // namespace
}  // namespace batten
