// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/flows/flow_data.h>
#include <batten/flows/flow_fit.h>

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

using testing::HasSubstr;

const Rectangle region(Interval(0, 1, 7), Interval(0, 1, 6));

/// An eddy with noise.
VectorObservations eddy(std::size_t count, unsigned seed, double noise) {
  test::Random random(seed);
  VectorObservations o;
  for (std::size_t i = 0; i < count; ++i) {
    o.x.push_back(random());
    o.y.push_back(random());
    o.u.push_back(-std::sin(6 * o.y.back()) + noise * random.normal());
    o.v.push_back(std::sin(6 * o.x.back()) + noise * random.normal());
  }
  return o;
}

/// Distance of what was fitted from vector i.
double away(const VectorObservations& o, const FlowResult& fit, std::size_t i, ToleranceNorm norm) {
  const double u = std::abs(fit.fitted_u[i] - o.u[i]), v = std::abs(fit.fitted_v[i] - o.v[i]);
  return norm == ToleranceNorm::Euclidean ? std::hypot(u, v) : std::max(u, v);
}

/// The least energy by dense active sets, balls by the tangents where they are left.
double least_energy(const VectorObservations& o, const FlowOptions& options) {
  const FlowData data = prepare_flow(o, region, options, false);
  FitOptions scalar;
  scalar.energy = energy_of(options.model);
  scalar.degree = options.degree;
  const FitProblem problem(data.rows, region, scalar);
  const auto n = static_cast<Eigen::Index>(problem.unknowns()), m = static_cast<Eigen::Index>(problem.size());
  Eigen::MatrixXd energy(n, n), rows(m, n);
  std::vector<double> c(problem.unknowns()), image(c.size());
  for (Eigen::Index j = 0; j < n; ++j) {
    std::fill(c.begin(), c.end(), 0.);
    c[static_cast<std::size_t>(j)] = 1;
    problem.apply_energy(c, image);
    const auto values = problem.values(c);
    energy.col(j) = Eigen::Map<const Eigen::VectorXd>(image.data(), n);
    rows.col(j) = Eigen::Map<const Eigen::VectorXd>(values.data(), m);
  }
  energy = (energy + energy.transpose()).eval() / 2;
  const double radius = options.smoothing.value / data.rows.scale;
  const Eigen::Map<const Eigen::VectorXd> value(problem.value().data(), m);
  test::HalfSpace next;
  const auto most_violated = [&](const Eigen::VectorXd& x) -> const test::HalfSpace* {
    const Eigen::VectorXd r = rows * x - value;
    double worst = 1e-7;
    for (Eigen::Index i = 0; i < m; i += 2) {
      Eigen::Vector2d direction = r.segment<2>(i);
      if (options.tolerance_norm == ToleranceNorm::Component)
        direction = std::abs(direction[0]) > std::abs(direction[1]) ? Eigen::Vector2d(direction[0], 0)
                                                                    : Eigen::Vector2d(0, direction[1]);
      const double length = direction.norm();
      if (length / radius - 1 <= worst) continue;
      worst = length / radius - 1;
      direction /= -length;
      next = {rows.middleRows<2>(i).transpose() * direction, direction.dot(value.segment<2>(i)) - radius};
    }
    return worst > 1e-7 ? &next : nullptr;
  };
  constexpr double slight = 1e-8;
  const Eigen::VectorXd x =
      test::QuadraticProgram(energy + slight * Eigen::MatrixXd::Identity(n, n), Eigen::VectorXd::Zero(n))
          .solve(most_violated);
  return x.dot(energy * x) * data.rows.scale * data.rows.scale;
}

TEST(FlowTolerance, gives_the_energy_of_dense_active_sets) {
  for (const ToleranceNorm norm : {ToleranceNorm::Component, ToleranceNorm::Euclidean})
    for (const FlowModel model : {FlowModel::Smooth, FlowModel::Slow, FlowModel::Irrotational})
      for (unsigned seed = 1; seed <= 10; ++seed) {
        const auto o = eddy(8 + 2 * seed, seed, 0.05 * (seed % 4));
        FlowOptions options;
        options.model = model;
        options.tolerance_norm = norm;
        options.smoothing = Smoothing::within(model == FlowModel::Irrotational ? 1 : 0.02 * (1 + seed));
        const auto fit = fit_flow(o, region, options);
        if (!fit.tolerance_reached) {
          EXPECT_THROW(least_energy(o, options), std::runtime_error) << seed;
          continue;
        }
        for (std::size_t i = 0; i < o.size(); ++i)
          EXPECT_LE(away(o, fit, i, norm), options.smoothing.value * (1 + 1e-9));
        const double least = least_energy(o, options);
        EXPECT_LE(fit.energy, (1 + 1e-3) * least + 1e-6) << seed;
        EXPECT_GE(fit.energy, (1 - 1e-4) * least - 1e-5) << seed;
      }
}

// A field without energy is within the tolerance, but not the one of least squares, which few vectors do not move.
TEST(FlowTolerance, is_without_energy_where_a_field_without_energy_will_do) {
  for (const ToleranceNorm norm : {ToleranceNorm::Component, ToleranceNorm::Euclidean})
    for (const FlowModel model : {FlowModel::Smooth, FlowModel::Slow, FlowModel::Irrotational, FlowModel::General}) {
      auto o = eddy(60, 9, 0);
      for (std::size_t i = 0; i < o.size(); ++i) {
        o.u[i] = 1 + (i % 15 == 0 ? 0.3 : 0);
        o.v[i] = 2;
      }
      FlowOptions options;
      options.model = model;
      options.tolerance_norm = norm;
      options.smoothing = Smoothing::within(0.16);  // (1.15, 2) will do
      const auto fit = fit_flow(o, region, options);
      EXPECT_TRUE(fit.tolerance_reached);
      EXPECT_LE(fit.energy, 1e-20);
      EXPECT_EQ(fit.constraints->cycles, 0);
    }
}

TEST(FlowTolerance, of_general_on_the_sphere_and_between_walls_is_kept_in_both_norms) {
  const Rectangle europe(Interval(-12, 30, 12), Interval(34, 62, 10));
  auto o = eddy(40, 3, 0.2);
  for (std::size_t i = 0; i < o.size(); ++i) {
    o.x[i] = -11 + 40 * o.x[i];
    o.y[i] = 35 + 26 * o.y[i];
  }
  FlowSides channel;
  channel.bottom = channel.top = FlowSide::Wall;
  for (const ToleranceNorm norm : {ToleranceNorm::Component, ToleranceNorm::Euclidean})
    for (const bool on_sphere : {true, false}) {
      FlowOptions options;
      options.model = on_sphere ? FlowModel::General : FlowModel::Smooth;
      options.geographic = on_sphere;
      if (!on_sphere) options.sides = channel;
      options.tolerance_norm = norm;
      options.smoothing = Smoothing::within(0.5);
      const auto fit = fit_flow(o, europe, options);
      ASSERT_TRUE(fit.tolerance_reached) << on_sphere;
      EXPECT_LE(fit.constraints->energy_gap, 1e-3);
      double largest = 0;
      for (std::size_t i = 0; i < o.size(); ++i) largest = std::max(largest, away(o, fit, i, norm));
      EXPECT_LE(largest, 0.5 * (1 + 1e-9));
      EXPECT_GT(largest, 0.49);
    }
}

TEST(FlowTolerance, that_no_field_on_the_grid_can_keep_names_the_least_that_one_can) {
  for (const ToleranceNorm norm : {ToleranceNorm::Component, ToleranceNorm::Euclidean}) {
    FlowOptions options;
    options.tolerance_norm = norm;
    options.smoothing = Smoothing::within(0.01);
    const auto o = eddy(120, 5, 0.3);
    const auto fit = fit_flow(o, region, options);
    EXPECT_FALSE(fit.tolerance_reached);
    ASSERT_TRUE(fit.constraints->least_tolerance);
    const double least = *fit.constraints->least_tolerance;
    options.smoothing = Smoothing::within(1.002 * least);
    EXPECT_TRUE(fit_flow(o, region, options).tolerance_reached);
    options.smoothing = Smoothing::within(0.99 * least);
    EXPECT_FALSE(fit_flow(o, region, options).tolerance_reached);
  }
}

TEST(FlowTolerance, gives_the_same_bits_for_every_number_of_threads) {
  const auto o = eddy(500, 7, 0.1);
  const Rectangle fine(Interval(0, 1, 40), Interval(0, 1, 40));
  for (const ToleranceNorm norm : {ToleranceNorm::Component, ToleranceNorm::Euclidean}) {
    FlowOptions options;
    options.tolerance_norm = norm;
    options.smoothing = Smoothing::within(0.2);
    const auto fitted = [&](int threads) {
      omp_set_num_threads(threads);
      const auto fit = fit_flow(o, fine, options);
      omp_set_num_threads(1);
      return fit.fitted_u;
    };
    const auto one = fitted(1);
    for (int threads : {2, 3}) EXPECT_EQ(fitted(threads), one) << threads;
  }
}

TEST(FlowTolerance, refuses_vectors_at_one_place_that_are_farther_apart) {
  auto o = eddy(20, 2, 0.1);
  for (auto* column : {&o.x, &o.y, &o.u, &o.v}) column->push_back(column->at(4));
  o.v.back() += 1;
  FlowOptions options;
  options.smoothing = Smoothing::within(0.3);
  options.name_of = [](std::size_t i) { return "line " + std::to_string(i + 2); };
  EXPECT_THAT(message_of<InvalidInput>([&] { fit_flow(o, region, options); }),
              testing::AllOf(HasSubstr("(line 6)"), HasSubstr("(line 22)")));
}

}  // namespace
}  // namespace batten
