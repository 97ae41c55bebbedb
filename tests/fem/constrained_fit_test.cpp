// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/constrained_fit.h>
#include <batten/fem/fit.h>

#include "../support/message_of.h"
#include "../support/observations.h"
#include "../support/quadratic_program.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

using test::franke;
using test::random_observations;
using test::unit_square;
using testing::HasSubstr;

FitOptions within(double tolerance, const Energy& energy = Energy::thin_plate(), int degree = 3) {
  FitOptions options;
  options.smoothing = Smoothing::within(tolerance);
  options.energy = energy;
  options.degree = degree;
  return options;
}

/// The region that the command takes: the box of the points widened by 5 % of its longer side.
Rectangle box_of(const Observations& o, int nx, int ny) {
  const auto [left, right] = std::minmax_element(o.x.begin(), o.x.end());
  const auto [bottom, top] = std::minmax_element(o.y.begin(), o.y.end());
  const double margin = 0.05 * std::max(*right - *left, *top - *bottom);
  return {Interval(*left - margin, *right + margin, nx), Interval(*bottom - margin, *top + margin, ny)};
}

/// Energy and rows of a fit as dense matrices, from the operators of the grid column by column.
struct Dense {
  explicit Dense(const FitProblem& problem)
      : energy(problem.unknowns(), problem.unknowns()), rows(problem.size(), problem.unknowns()) {
    std::vector<double> c(problem.unknowns()), image(c.size());
    for (std::size_t j = 0; j < c.size(); ++j) {
      std::fill(c.begin(), c.end(), 0.);
      c[j] = 1;
      problem.apply_energy(c, image);
      const auto values = problem.values(c);
      energy.col(static_cast<Eigen::Index>(j)) = Eigen::Map<const Eigen::VectorXd>(image.data(), energy.rows());
      rows.col(static_cast<Eigen::Index>(j)) = Eigen::Map<const Eigen::VectorXd>(values.data(), rows.rows());
    }
    energy = (energy + energy.transpose()).eval() / 2;
  }
  Eigen::MatrixXd energy, rows;
};

/// The least energy within boxes around the values: dense, by active sets. `slight` makes the energy definite; it adds
/// less than slight |c|².
double least_energy(const Dense& dense, std::span<const double> value, double tolerance) {
  constexpr double slight = 1e-8;
  const Eigen::Index n = dense.energy.rows();
  const Eigen::MatrixXd g = dense.energy + slight * Eigen::MatrixXd::Identity(n, n);
  test::HalfSpace next;
  const auto most_violated = [&](const Eigen::VectorXd& x) -> const test::HalfSpace* {
    const Eigen::VectorXd v = dense.rows * x;
    double worst = 1e-9;
    for (Eigen::Index i = 0; i < v.size(); ++i) {
      const double r = v[i] - value[static_cast<std::size_t>(i)];
      if (std::abs(r) / tolerance - 1 <= worst) continue;
      worst = std::abs(r) / tolerance - 1;
      const double sign = r > 0 ? -1 : 1;
      next = {sign * dense.rows.row(i).transpose(), sign * value[static_cast<std::size_t>(i)] - tolerance};
    }
    return worst > 1e-9 ? &next : nullptr;
  };
  const Eigen::VectorXd x = test::QuadraticProgram(g, Eigen::VectorXd::Zero(n)).solve(most_violated);
  return x.dot(dense.energy * x);
}

TEST(LeastEnergyWithin, equals_dense_active_sets_on_200_random_surfaces) {
  const std::vector<Energy> energies = {Energy::thin_plate(), Energy::tension(0.5), Energy::membrane()};
  for (unsigned seed = 1; seed <= 200; ++seed) {
    test::Random random(seed);
    const int degree = 2 + static_cast<int>(seed % 2), nx = 3 + static_cast<int>(7 * random()),
              ny = 3 + static_cast<int>(7 * random());
    const auto count = static_cast<std::size_t>(5 + 35 * random());
    const double noise = std::pow(10., -3 + 3 * random());
    const auto o =
        random_observations(count, seed, [&](double x, double y) { return franke(x, y) + noise * random.normal(); });
    // from well within the noise to beyond all data
    const double tolerance = noise * (0.2 + 4.8 * random());
    FitOptions options = within(tolerance, energies[seed % 3], degree);
    const Rectangle region = unit_square(nx, ny);
    const auto prepared = prepare(o, region, options.energy, false);
    FitProblem problem(prepared.data, region, options);
    const auto fit = fit_surface(o, region, options);
    const double scale = prepared.data.scale;
    if (!fit.tolerance_reached) {
      ASSERT_TRUE(fit.constraints->least_tolerance) << seed;
      EXPECT_GT(*fit.constraints->least_tolerance, tolerance) << seed;
      EXPECT_THROW(least_energy(Dense(problem), problem.value(), tolerance / scale), std::runtime_error) << seed;
      continue;
    }
    EXPECT_LE(fit.largest_residual, tolerance * (1 + 1e-9)) << seed;
    EXPECT_LE(fit.constraints->energy_gap, 1e-3) << seed;
    const double least = least_energy(Dense(problem), problem.value(), tolerance / scale);
    // the gap of energies below 1e-8 is one in parts of 1e-8; the dense energy has one that is slight besides
    EXPECT_LE(fit.energy / (scale * scale), least + 1e-3 * std::max(least, 1e-8) + 1e-9) << seed;
    EXPECT_GE(fit.energy / (scale * scale), (1 - 1e-6) * least - 1e-6) << seed;
  }
}

TEST(LeastEnergyWithin, is_none_where_a_function_without_energy_will_do) {
  Observations five;
  five.x = {0, 1, 0, 1, 0.5};
  five.y = {0, 0, 1, 1, 0.5};
  five.value = {0, 1, 1, 0, 2};
  const auto flat = fit_surface(five, box_of(five, 12, 12), within(1.1));
  EXPECT_EQ(flat.energy, 0);
  EXPECT_LE(flat.largest_residual, 1.1);
  const auto topo = test::example_data("topo.csv", 0, 1, 2);  // a plane is within 77.6
  const auto plane = fit_surface(topo, box_of(topo, 32, 32), within(77.7));
  EXPECT_EQ(plane.energy, 0);
  EXPECT_LE(plane.largest_residual, 77.7);
  const auto bent = fit_surface(topo, box_of(topo, 32, 32), within(77.5));
  EXPECT_GT(bent.energy, 0);
  EXPECT_LT(bent.energy, 10);
  // the membrane has constants alone
  EXPECT_GT(fit_surface(topo, box_of(topo, 32, 32), within(77.7, Energy::membrane())).energy, 1);
}

// Numbers of independent dense solutions.
TEST(LeastEnergyWithin, has_the_energies_of_dense_solutions_of_real_data) {
  const auto topo = test::example_data("topo.csv", 0, 1, 2), volcano = test::example_data("volcano.csv", 0, 1, 2);
  const auto heights = fit_surface(topo, box_of(topo, 32, 32), within(20));
  EXPECT_NEAR(heights.energy, 2.58920e6, 1e-3 * 2.58920e6);
  const Rectangle region(Interval(-43, 903, 128), Interval(-43, 643, 96));
  const auto crater = fit_surface(volcano, region, within(1));
  EXPECT_NEAR(crater.energy, 5.373629e7, 1e-3 * 5.373629e7);
  EXPECT_NEAR(static_cast<double>(crater.constraints->active), 780, 0.1 * 780);
  EXPECT_LE(crater.largest_residual, 1 + 1e-9);
}

TEST(LeastEnergyWithin, spends_at_most_so_many_cycles) {
  const auto volcano = test::example_data("volcano.csv", 0, 1, 2), rain = test::example_data("rmprecip.csv", 0, 1, 3);
  const Rectangle region(Interval(-43, 903, 256), Interval(-43, 643, 192));
  const auto crater = fit_surface(volcano, region, within(1));
  EXPECT_NEAR(crater.energy, 5.248618e7, 1e-3 * 5.248618e7);
  EXPECT_LE(crater.constraints->cycles, 450);
  EXPECT_LE(fit_surface(rain, box_of(rain, 256, 256), within(20)).constraints->cycles, 300);
  const auto random = random_observations(2000, 1, franke);
  for (const double tolerance : {0.05, 0.01, 0.001})
    EXPECT_LE(fit_surface(random, unit_square(256, 256), within(tolerance)).constraints->cycles, 400) << tolerance;
}

// 1.1527 is that of a linear program.
TEST(LeastTolerance, of_a_grid_is_found_and_can_be_met) {
  const auto volcano = test::example_data("volcano.csv", 0, 1, 2);
  const Rectangle region(Interval(-43, 903, 64), Interval(-43, 643, 48));
  const auto fit = fit_surface(volcano, region, within(1));
  EXPECT_FALSE(fit.tolerance_reached);
  ASSERT_TRUE(fit.constraints->least_tolerance);
  EXPECT_NEAR(*fit.constraints->least_tolerance, 1.1527, 2e-4);
  EXPECT_LE(fit.largest_residual, *fit.constraints->least_tolerance * (1 + 1e-9));
}

TEST(LeastTolerance, separates_what_can_be_met_from_what_cannot) {
  const auto o = random_observations(200, 2, [&](double x, double y) { return std::sin(40 * x) * std::cos(30 * y); });
  const double least = fit_surface(o, unit_square(6, 6), within(0.01)).constraints->least_tolerance.value();
  EXPECT_TRUE(fit_surface(o, unit_square(6, 6), within(1.002 * least)).tolerance_reached);
  const auto below = fit_surface(o, unit_square(6, 6), within(0.998 * least));
  EXPECT_FALSE(below.tolerance_reached);
  EXPECT_NEAR(below.constraints->least_tolerance.value(), least, 1e-3 * least);
}

TEST(LeastEnergyWithin, is_the_same_for_every_number_of_threads) {
  const auto o = random_observations(600, 5, franke);
  FitOptions options = within(0.02);
  options.minimum = 0;
  const auto fitted = [&](int threads) {
    omp_set_num_threads(threads);
    const auto fit = fit_surface(o, unit_square(70, 60), options);
    omp_set_num_threads(1);
    return std::vector<double>(fit.solution.coefficients().begin(), fit.solution.coefficients().end());
  };
  const auto one = fitted(1);
  for (int threads : {2, 3, 8}) EXPECT_EQ(fitted(threads), one) << threads;
}

std::string message(const Observations& o, const FitOptions& options) {
  return message_of<InvalidInput>([&] { fit_surface(o, unit_square(8, 8), options); });
}

TEST(Contradictions, are_named_with_their_observations) {
  Observations o;
  o.x = {0.1, 0.9, 0.5, 0.1, 0.3};
  o.y = {0.1, 0.2, 0.9, 0.1, 0.3};
  o.value = {1, 2, 3, 4, -5};
  EXPECT_THAT(message(o, within(1)),
              testing::AllOf(HasSubstr("found 1 (observation 1) and 4 (observation 4)"), HasSubstr("at (0.1, 0.1)")));
  FitOptions options = within(2);
  options.minimum = 0;
  EXPECT_THAT(message(o, options),
              HasSubstr("minimum 0, found -5 in observation 5, farther from it than the tolerance"));
  options.name_of = [](std::size_t i) { return "line " + std::to_string(i + 2); };
  EXPECT_THAT(message(o, options), HasSubstr("found -5 in line 6"));
  options.smoothing = Smoothing::none();
  options.minimum = -6;
  options.maximum = 1.5;
  EXPECT_THAT(message(o, options), HasSubstr("maximum 1.5, found 2 in line 3"));
  options.maximum = -6;
  EXPECT_THAT(message(o, options), HasSubstr("a minimum below the maximum, found -6 and -6"));
  options.maximum = std::nan("");
  EXPECT_THAT(message(o, options), HasSubstr("finite maximum"));
}

TEST(Contradictions, of_points_that_are_left_out_do_not_count) {
  auto o = random_observations(30, 1, franke);
  for (int k = 0; k < 2; ++k) {
    o.x.push_back(7);
    o.y.push_back(7);
    o.value.push_back(1000 * k);
  }
  EXPECT_TRUE(fit_surface(o, unit_square(8, 8), within(0.2)).tolerance_reached);
}

}  // namespace
}  // namespace batten
