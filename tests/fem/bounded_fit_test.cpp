// SPDX-License-Identifier: MIT
#include <batten/fem/fit.h>
#include <batten/fem/fit_problem.h>

#include "../support/observations.h"
#include "../support/quadratic_program.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

using test::random_observations;
using test::unit_square;

/// Rain: nothing in half of the region, hills elsewhere.
double showers(double x, double y) { return std::max(0., test::franke(x, y) - 0.3); }

FitOptions not_below(double minimum, const Smoothing& smoothing) {
  FitOptions options;
  options.smoothing = smoothing;
  options.minimum = minimum;
  return options;
}

/// The least and the largest value at `samples` x `samples` places in every cell, sides included.
std::pair<double, double> range_of(const Solution& solution, int samples) {
  const auto& [x, y] = solution.region();
  double low = INFINITY, high = -INFINITY;
  for (int j = 0; j <= samples * y.cells(); ++j)
    for (int i = 0; i <= samples * x.cells(); ++i) {
      const double v = solution.value(x.lower() + x.length() * i / (samples * x.cells()),
                                      y.lower() + y.length() * j / (samples * y.cells()));
      low = std::min(low, v);
      high = std::max(high, v);
    }
  return {low, high};
}

TEST(BoundedFit, stays_within_the_bounds_everywhere) {
  test::Random random(4);
  for (const auto& smoothing :
       {Smoothing::automatic(), Smoothing::fixed(1e-6), Smoothing::none(), Smoothing::within(0.02)})
    for (int degree : {2, 3}) {
      auto o = random_observations(150, 3, [](double x, double y) { return std::min(0.6, showers(x, y)); });
      FitOptions options = not_below(0, smoothing);
      options.maximum = 0.6;
      options.degree = degree;
      const auto fit = fit_surface(o, unit_square(24, 20), options);
      const auto [low, high] = range_of(fit.solution, 7);
      EXPECT_GE(low, 0);
      EXPECT_LE(high, 0.6);
      ASSERT_TRUE(fit.constraints);
      EXPECT_LE(fit.constraints->energy_gap, 1e-3);
      EXPECT_GT(fit.constraints->active, 0u);
      options.minimum = options.maximum = std::nullopt;
      EXPECT_LT(range_of(fit_surface(o, unit_square(24, 20), options).solution, 7).first, -1e-3);
    }
}

TEST(BoundedFit, is_the_free_one_where_that_is_within) {
  const auto o = random_observations(200, 3, test::franke);
  const auto free = fit_surface(o, unit_square(16, 16), {.smoothing = Smoothing::fixed(1e-5)});
  const auto bounded = fit_surface(o, unit_square(16, 16), not_below(-3, Smoothing::fixed(1e-5)));
  EXPECT_TRUE(std::equal(free.solution.coefficients().begin(), free.solution.coefficients().end(),
                         bounded.solution.coefficients().begin()));
  EXPECT_EQ(bounded.constraints->active, 0u);
}

TEST(BoundedFit, meets_data_that_lie_at_the_bound) {
  const auto o = random_observations(60, 6, showers);
  ASSERT_GT(std::count(o.value.begin(), o.value.end(), 0.), 15);
  const auto fit = fit_surface(o, unit_square(20, 20), not_below(0, Smoothing::none()));
  EXPECT_LE(fit.largest_residual, 3e-5);
  EXPECT_GE(range_of(fit.solution, 5).first, 0);
}

TEST(BoundedFit, finds_lambda_without_the_bounds) {
  test::Random random(8);
  const auto o =
      random_observations(300, 3, [&](double x, double y) { return showers(x, y) + 0.02 * random.normal(); });
  FitOptions options;
  const double lambda = fit_surface(o, unit_square(24, 24), options).lambda;
  EXPECT_EQ(fit_surface(o, unit_square(24, 24), not_below(0, Smoothing::automatic())).lambda, lambda);
}

/// Value of the functions at a place, a row of coefficients.
Eigen::VectorXd row_at(const SplineSpace& space, double x, double y) {
  const auto a = space.x.at(x), b = space.y.at(y);
  Eigen::VectorXd row = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(space.size()));
  for (int j = 0; j <= space.y.degree(); ++j)
    for (int i = 0; i <= space.x.degree(); ++i)
      row[(b.first + j) * space.x.size() + a.first + i] =
          a.values[static_cast<std::size_t>(i)] * b.values[static_cast<std::size_t>(j)];
  return row;
}

// What is bounded are finer coefficients, not the values themselves: against bounds at 16 x 16 places of each cell, by
// dense active sets, the energy (with the misfit) is a little higher. On cells so wide that one of them holds a whole
// dip that is up to 10 %, on those that resolve the data far less than 1 %.
TEST(BoundedFit, costs_little_more_than_bounds_at_dense_places) {
  constexpr int cells = 10, samples = 16;
  for (const double lambda : {1e-8, 1e-5})
    for (unsigned seed : {1, 2}) {
      const auto o = random_observations(60, seed, showers);
      const Rectangle region = unit_square(cells, cells);
      FitOptions options = not_below(0, Smoothing::fixed(lambda));
      const auto fit = fit_surface(o, region, options);
      const auto prepared = prepare(o, region, options.energy, false);
      const FitData& data = prepared.data;
      FitProblem problem(data, region, options);
      problem.set(lambda);
      const auto n = static_cast<Eigen::Index>(problem.unknowns());
      Eigen::MatrixXd g(n, n);
      std::vector<double> unit(problem.unknowns()), image(unit.size());
      for (Eigen::Index j = 0; j < n; ++j) {
        std::fill(unit.begin(), unit.end(), 0.);
        unit[static_cast<std::size_t>(j)] = 1;
        problem.apply(unit, image);
        g.col(j) = Eigen::Map<const Eigen::VectorXd>(image.data(), n);
      }
      g = (g + g.transpose()).eval() / 2;
      const auto b = problem.right_side(problem.weight(), problem.value());
      const Eigen::VectorXd right = Eigen::Map<const Eigen::VectorXd>(b.data(), n);
      const auto& space = problem.hierarchy().finest().space;
      test::HalfSpace next;
      const auto most_violated = [&](const Eigen::VectorXd& x) -> const test::HalfSpace* {
        const Solution p(region, 3, {x.begin(), x.end()});
        double worst = 1e-9;
        for (int j = 0; j <= samples * cells; ++j)
          for (int i = 0; i <= samples * cells; ++i) {
            const double s = i / static_cast<double>(samples * cells), t = j / static_cast<double>(samples * cells);
            const double bound = -data.null_element(s, t) / data.scale, miss = bound - p.value(s, t);
            if (miss <= worst) continue;
            worst = miss;
            next = {row_at(space, s * cells, t * cells), bound};
          }
        return worst > 1e-9 ? &next : nullptr;
      };
      const Eigen::VectorXd x = test::QuadraticProgram(g, right).solve(most_violated);
      double squares = 0;
      for (std::size_t i = 0; i < data.size(); ++i) squares += data.weight[i] * data.value[i] * data.value[i];
      const double least = squares + x.dot(g * x) - 2 * right.dot(x);
      const double found = (fit.rms_residual * fit.rms_residual + lambda * fit.energy) / (data.scale * data.scale);
      EXPECT_GE(found, least * (1 - 1e-6)) << lambda << " " << seed;
      EXPECT_LE(found, (lambda < 1e-6 ? 1.1 : 1.01) * least) << lambda << " " << seed;
    }
}

TEST(BoundedFit, within_a_tolerance_that_the_bounds_forbid_names_the_least) {
  Observations o;  // heights and zeros that alternate faster than cells do
  for (int k = 0; k <= 20; ++k)
    for (int l = 0; l <= 20; ++l) {
      o.x.push_back(k / 20.);
      o.y.push_back(l / 20.);
      o.value.push_back((k + l) % 2);
    }
  const auto fit = fit_surface(o, unit_square(6, 6), not_below(0, Smoothing::within(0.1)));
  EXPECT_FALSE(fit.tolerance_reached);
  ASSERT_TRUE(fit.constraints->least_tolerance);
  EXPECT_GT(*fit.constraints->least_tolerance, 0.1);
  EXPECT_LE(*fit.constraints->least_tolerance, 0.5 * (1 + 1e-4));  // the constant 0.5
  EXPECT_GE(range_of(fit.solution, 7).first, 0);
}

}  // namespace
}  // namespace batten
