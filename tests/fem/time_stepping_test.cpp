// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/time_stepping.h>
#include <batten/fem/vibration.h>

#include "../support/message_of.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace batten {
namespace {

constexpr double pi = std::numbers::pi;

Rectangle unit_square(int cells) { return {Interval(0, 1, cells), Interval(0, 1, cells)}; }

Sides all(const Side& side) { return {side, side, side, side}; }

double sines(double x, double y) { return std::sin(pi * x) * std::sin(pi * y); }

BoundaryProblem membrane(int cells, int degree, const Side& side) {
  return {Conduction{}, unit_square(cells), degree, all(side), {}, {}};
}

BoundaryProblem plate(int cells, int degree, const Side& side) {
  return {KirchhoffPlate{}, unit_square(cells), degree, all(side), {}, {}};
}

struct Track {
  std::vector<double> times, values;  // at one place
  std::vector<Solution> states;
  MarchResult result;
};

Track track(const BoundaryProblem& problem, const Motion& motion, double x, double y, double accuracy = 1e-10) {
  Track t;
  t.result = march(problem, motion,
                   [&](double time, const Solution& state) {
                     t.times.push_back(time);
                     t.values.push_back(state.value(x, y));
                     t.states.push_back(state);
                   },
                   {.limits = {.accuracy = accuracy}});
  return t;
}

/// What a stable and L-stable method of order 2 with one double pole makes of e^z, γ = 1 - √½.
double l_stable_factor(double z) {
  const double gamma = 1 - std::sqrt(0.5);
  return (1 + (1 - 2 * gamma) * z) / std::pow(1 - gamma * z, 2);
}

TEST(Heat, decays_at_the_known_rate_with_order_2_in_the_step) {
  auto problem = membrane(16, 5, Side::fixed());
  problem.material = Conduction{0.5, 0.};
  Motion motion{.end = 0.2, .step = 0.02, .initial = Field(sines)};
  const double rate = 2 * pi * pi * 0.5;
  double before = 0;
  for (int k = 0; k < 3; ++k, motion.step /= 2) {
    const auto found = track(problem, motion, 0.5, 0.5);
    EXPECT_EQ(found.times.size(), static_cast<std::size_t>(found.result.steps) + 1);
    EXPECT_NEAR(found.values.back(), std::pow(l_stable_factor(-rate * motion.step), found.result.steps), 1e-8);
    const double error = std::abs(found.values.back() - std::exp(-rate * motion.end));
    if (k > 0) {
      EXPECT_NEAR(std::log2(before / error), 2, 0.1);
    }
    before = error;
  }
}

TEST(Heat, with_a_density_and_insulated_sides_keeps_its_amount) {
  auto problem = membrane(16, 3, Side::free());
  const Field density([](double x, double) { return 1 + x; });
  const auto found = track(problem, {.end = 2, .step = 0.1, .initial = Field(sines), .density = density}, 0.9, 0.1);
  // ∫∫ (1 + x) u dx dy over ∫∫ (1 + x): (4 / π²) 3/2 over 3/2
  EXPECT_NEAR(found.values.back(), 4 / (pi * pi), 2e-5);
}

TEST(Heat, comes_to_rest_at_the_solution_of_the_boundary_value_problem) {
  auto problem = membrane(24, 3, Side::fixed());
  problem.sides.left = Side::fixed(Field([](double, double y) { return y * (1 - y); }));
  problem.sides.top = Side::free();
  problem.loads.area = Field([](double x, double y) { return 10 * x * y; });
  problem.supports.points = {{0.6, 0.4, 0.3, 0.1}};
  problem.material = Conduction{Field([](double x, double) { return 1 + x; }), 0.};
  const auto found = track(problem, {.end = 6, .step = 0.25}, 0.3, 0.8);
  const auto still = solve_boundary_problem(problem).solution;
  for (const double y : {0.2, 0.5, 0.8, 1.})
    for (const double x : {0.1, 0.4, 0.6, 0.9})
      EXPECT_NEAR(found.states.back().value(x, y), still.value(x, y), 1e-8) << x << " " << y;
}

TEST(Heat, is_damped_at_steps_far_longer_than_its_fastest_decay) {
  const auto problem = membrane(32, 2, Side::fixed());
  const auto found = track(problem, {.end = 10, .step = 1, .initial = 1.}, 0.5, 0.5);
  EXPECT_LT(std::abs(found.values[2]), 0.05);
  EXPECT_LT(std::abs(found.values.back()), 1e-6);
}

/// ∫∫ of the squares of a derivative of a spline, by its values at Gauss points.
double square_integral(const Solution& s, int a, int b) {
  constexpr std::array places = {-0.861136311594053, -0.339981043584856, 0.339981043584856, 0.861136311594053};
  constexpr std::array weights = {0.347854845137454, 0.652145154862546, 0.652145154862546, 0.347854845137454};
  const int n = s.region().x.cells();
  double sum = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      for (std::size_t q = 0; q < 4; ++q)
        for (std::size_t p = 0; p < 4; ++p) {
          const double value = s.derivative((i + 0.5 + places[p] / 2) / n, (j + 0.5 + places[q] / 2) / n, a, b);
          sum += weights[p] * weights[q] * value * value / (4. * n * n);
        }
  return sum;
}

Solution combined(double factor, const Solution& a, double other, const Solution& b) {
  std::vector<double> c(a.coefficients().begin(), a.coefficients().end());
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = factor * c[i] + other * b.coefficients()[i];
  return {a.region(), a.degree(), std::move(c)};
}

/// Twice the energy of motion and bending of a clamped plate.
double energy_of(const Solution& velocity, const Solution& w) {
  return square_integral(velocity, 0, 0) + square_integral(w, 2, 0) + 2 * square_integral(w, 1, 1) +
         square_integral(w, 0, 2);
}

TEST(PlateMotion, without_damping_keeps_its_energy_over_200_steps) {
  const auto problem = plate(16, 3, Side::clamped());
  const Field bump([](double x, double y) { return std::pow(sines(x, y), 2) * (1 + x + y * y); });
  const Motion motion{.end = 1, .step = 0.005, .initial = bump};
  for (const double accuracy : {1e-10, 1e-4}) {  // it does not depend on the accuracy of the steps
    const auto found = track(problem, motion, 0.5, 0.5, accuracy);
    ASSERT_EQ(found.result.steps, 200);
    Solution velocity = combined(0, found.states[0], 0, found.states[0]);
    const double first = energy_of(velocity, found.states[0]);
    for (std::size_t k = 0; k < 200; ++k) {  // (v_1 + v_0) / 2 = (w_1 - w_0) / dt
      const auto way = combined(1, found.states[k + 1], -1, found.states[k]);
      velocity = combined(2 / motion.step, way, -1, velocity);
      if (k % 20 == 19) {
        EXPECT_NEAR(energy_of(velocity, found.states[k + 1]), first, 1e-8 * first) << k;
      }
    }
  }
}

/// Of the trapezoidal rule: tan(ω' dt / 2) = ω dt / 2.
double discrete_frequency(double omega, double dt) { return 2 / dt * std::atan(omega * dt / 2); }

TEST(PlateMotion, swings_in_its_lowest_mode_with_the_known_period) {
  auto problem = plate(16, 5, Side::simply_supported());
  problem.material = KirchhoffPlate{3};
  const double omega = std::sqrt(3 / 2.) * 2 * pi * pi;
  const Motion motion{.end = 2 * pi / omega, .step = 2 * pi / omega / 200, .initial = Field(sines), .density = 2.};
  const auto found = track(problem, motion, 0.5, 0.5);
  const double discrete = discrete_frequency(omega, motion.step);
  for (std::size_t k = 0; k < found.times.size(); ++k)
    EXPECT_NEAR(found.values[k], std::cos(discrete * found.times[k]), 1e-7) << k;
  EXPECT_NEAR(found.values.back(), 1, 1e-3);
}

TEST(PlateMotion, starts_with_its_velocity) {
  const auto problem = plate(16, 5, Side::simply_supported());
  const double omega = 2 * pi * pi;
  const auto found = track(problem, {.end = 0.1, .step = 0.001, .velocity = Field(sines)}, 0.5, 0.5);
  EXPECT_NEAR(found.values.back(), std::sin(omega * 0.1) / omega, 1e-4 / omega);
}

TEST(PlateMotion, is_damped_at_the_known_rate) {
  const auto problem = plate(16, 5, Side::simply_supported());
  const double damping = 1.2, density = 0.8, rate = damping / (2 * density);
  const double omega = std::sqrt(4 * std::pow(pi, 4) / density - rate * rate);
  const Motion motion{.end = 1, .step = 0.002, .initial = Field(sines), .damping = damping, .density = density};
  const auto found = track(problem, motion, 0.5, 0.5);
  const auto exact = [&](double t) {
    return std::exp(-rate * t) * (std::cos(omega * t) + rate / omega * std::sin(omega * t));
  };
  // The rule of order 2 is late by ω³ dt² / 12 in phase.
  for (std::size_t k = 0; k < found.times.size(); ++k) {
    const double t = found.times[k], late = std::pow(omega, 3) * 0.002 * 0.002 / 12 * t;
    EXPECT_NEAR(found.values[k], exact(t), std::exp(-rate * t) * (late + 1e-3)) << t;
  }
}

TEST(PlateMotion, comes_to_rest_at_the_solution_of_the_boundary_value_problem) {
  auto problem = plate(8, 3, Side::clamped());  // steps short enough to damp its highest mode
  problem.sides.right = Side::free();
  problem.sides.top = Side::clamped(Field([](double x, double) { return 0.01 * x * x; }));
  problem.sides.left = Side::clamped();
  problem.loads.area = 1.;
  problem.supports.points = {{0.8, 0.4, 0}};
  problem.material = KirchhoffPlate{Field([](double x, double y) { return 1 + x * y; })};
  const auto still = solve_boundary_problem(problem).solution;
  const Field start([&](double x, double y) {
    const double distance = std::hypot(x - 0.8, y - 0.4);  // to the support
    return still.value(x, y) + std::pow(x * (1 - x) * y * (1 - y) * distance, 2);
  });
  const auto found = track(problem, {.end = 1.5, .step = 0.001, .initial = start, .damping = 40}, 0.7, 0.7);
  for (const double y : {0.3, 0.7})
    for (const double x : {0.2, 0.6, 0.8, 1.})
      EXPECT_NEAR(found.states.back().value(x, y), still.value(x, y), 1e-9) << x << " " << y;
  for (const auto& state : found.states) EXPECT_NEAR(state.value(0.8, 0.4), 0, 1e-10);
}

TEST(PlateMotion, of_a_free_plate_under_a_load_is_that_of_a_body) {
  auto problem = plate(16, 3, Side::free());
  problem.loads.area = 3.;
  const auto found = track(problem, {.end = 2, .step = 0.1, .initial = 1., .velocity = -2., .density = 1.5}, 0.9, 0.2);
  for (std::size_t k = 0; k < found.times.size(); ++k) {
    const double t = found.times[k];  // the rule is exact for a constant acceleration
    EXPECT_NEAR(found.values[k], 1 - 2 * t + t * t, 1e-8) << t;
  }
}

TEST(March, shortens_the_last_step_to_the_end) {
  const auto problem = membrane(16, 5, Side::fixed());
  const double rate = 2 * pi * pi;
  const auto found = track(problem, {.end = 0.05, .step = 0.02, .initial = Field(sines)}, 0.5, 0.5);
  EXPECT_EQ(found.times, (std::vector<double>{0, 0.02, 0.04, 0.05}));
  EXPECT_NEAR(found.values.back(), std::pow(l_stable_factor(-rate * 0.02), 2) * l_stable_factor(-rate * 0.01), 1e-8);
  const auto once = track(problem, {.end = 0.01, .step = 0.02, .initial = Field(sines)}, 0.5, 0.5);
  EXPECT_EQ(once.times, (std::vector<double>{0, 0.01}));
  EXPECT_NEAR(once.values.back(), l_stable_factor(-rate * 0.01), 1e-8);
  EXPECT_EQ(track(problem, {.end = 0.3, .step = 0.1}, 0.5, 0.5).times.size(), 4u);  // 3 * 0.1 > 0.3 in doubles
}

TEST(March, needs_few_cycles_for_a_step_on_every_grid) {
  for (int cells : {32, 64}) {
    const Motion motion{.end = 0.2, .step = 0.01, .initial = Field(sines)};
    EXPECT_LE(track(membrane(cells, 3, Side::fixed()), motion, 0, 0).result.cycles, 20 * 6) << cells;
    EXPECT_LE(track(plate(cells, 3, Side::clamped()), motion, 0, 0).result.cycles, 20 * 9) << cells;
  }
}

TEST(March, starts_from_the_projection_onto_what_sides_and_supports_allow) {
  auto problem = plate(32, 3, Side::clamped());
  problem.supports.points = {{0.5, 0.5, 0.25}};
  const auto found = track(problem, {.end = 0.001, .step = 0.001, .initial = 1.}, 0.5, 0.5);
  EXPECT_NEAR(found.values.front(), 0.25, 1e-11);
  EXPECT_NEAR(found.states.front().value(0.25, 0.25), 1, 1e-2);
  EXPECT_EQ(found.states.front().value(0, 0.3), 0);
}

std::string refusal(const BoundaryProblem& problem, const Motion& motion) {
  return message_of<InvalidInput>([&] { march(problem, motion, [](double, const Solution&) {}); });
}

TEST(March, refuses_bad_input_with_what_was_expected_and_found) {
  const auto heat = membrane(8, 2, Side::fixed()), swing = plate(8, 3, Side::clamped());
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(heat, {.step = 0}), "march: expected a step > 0, found 0");
  EXPECT_EQ(refusal(heat, {.step = nan}), "march: expected a step > 0, found nan");
  EXPECT_EQ(refusal(heat, {.end = -1}), "march: expected an end > 0, found -1");
  EXPECT_EQ(refusal(heat, {.end = 1, .step = 1e-12}), "march: expected at most 1e9 steps, found 1e+12");
  EXPECT_EQ(refusal(swing, {.damping = -2}), "march: expected a damping >= 0, found -2");
  EXPECT_EQ(refusal(heat, {.damping = 2}), "march: expected no damping, which plates alone have, found 2");
  EXPECT_EQ(refusal(heat, {.velocity = 1}),
            "march: expected no velocity at time 0, which plates alone have, found one");
  EXPECT_EQ(refusal(swing, {.density = -1}), "Mass: expected a density > 0, found -1");
  EXPECT_EQ(refusal(swing, {.initial = nan}), "march: expected finite initial values, found nan");
  EXPECT_NE(refusal(swing, {.velocity = Field([](double x, double) { return std::sqrt(x - 2); })})
                .find("march: expected finite initial velocities, found -nan at (0.0"),
            std::string::npos);
}

}  // namespace
}  // namespace batten
