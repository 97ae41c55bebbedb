// SPDX-License-Identifier: MIT
#include <batten/bases/gauss_rule.h>
#include <batten/domains/errors.h>
#include <batten/fem/hierarchy.h>
#include <batten/flows/flow_fit.h>

#include "../support/message_of.h"
#include "../support/observations.h"
#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

using testing::HasSubstr;

constexpr double pi = 3.14159265358979323846;

struct Vector {
  double u, v;
};
using Field = std::function<Vector(double x, double y)>;

Vector taylor_green(double x, double y) {
  return {std::sin(pi * x) * std::cos(pi * y), -std::cos(pi * x) * std::sin(pi * y)};
}

VectorObservations samples(const Rectangle& region, std::size_t n, unsigned seed, const Field& field) {
  test::Random random(seed);
  VectorObservations o;
  for (std::size_t i = 0; i < n; ++i) {
    o.x.push_back(region.x.lower() + region.x.length() * random());
    o.y.push_back(region.y.lower() + region.y.length() * random());
    const auto [u, v] = field(o.x.back(), o.y.back());
    o.u.push_back(u);
    o.v.push_back(v);
  }
  return o;
}

const Rectangle wide = {Interval(10, 13, 12), Interval(-1, 1, 8)};

double largest_error(const FlowField& found, const Field& exact) {
  double worst = 0;
  for (int j = 0; j <= 10; ++j)
    for (int i = 0; i <= 10; ++i) {
      const double x = 10 + 0.3 * i, y = -1 + 0.2 * j;
      const auto v = found.velocity(x, y);
      const auto [u0, v0] = exact(x, y);
      worst = std::max({worst, std::abs(v.u - u0), std::abs(v.v - v0)});
    }
  return worst;
}

TEST(FlowFit, reproduces_the_fields_without_energy) {
  const Field constant = [](double, double) { return Vector{3, -7}; };
  const Field turning = [](double x, double y) { return Vector{1 + 2 * x - 3 * y, 5 + x - 2 * y}; };
  const Field strain = [](double x, double y) { return Vector{1 + 2 * x + y, 5 + x - 4 * y}; };
  for (const Smoothing smoothing : {Smoothing::automatic(), Smoothing::fixed(0.1), Smoothing::none()}) {
    const auto fit = [&](FlowModel model, const Field& field) {
      return largest_error(fit_flow(samples(wide, 40, 3, field), wide, {.model = model, .smoothing = smoothing}).field,
                           field);
    };
    EXPECT_LT(fit(FlowModel::Smooth, constant), 1e-12);
    EXPECT_LT(fit(FlowModel::Smooth, turning), 1e-11);
    EXPECT_LT(fit(FlowModel::Slow, constant), 1e-12);
    EXPECT_LT(fit(FlowModel::Irrotational, constant), 1e-12);
    EXPECT_LT(fit(FlowModel::Irrotational, strain), 1e-11);
    EXPECT_LT(fit(FlowModel::General, strain), 1e-11);
  }
}

/// One row of B: u or v of the rotation or the gradient of each function, in the coordinates of the region over its
/// longer side.
Eigen::VectorXd dense_row(const SplineSpace& space, double px, double py, bool is_v, bool is_potential) {
  Eigen::VectorXd row = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(space.size()));
  const bool sx = is_v != is_potential;
  const auto x = space.x.at(px, sx), y = space.y.at(py, !sx);
  const double factor = (sx ? 1 / space.hx : 1 / space.hy) * (sx && !is_potential ? -1 : 1);
  for (int q = 0; q <= space.y.degree(); ++q)
    for (int p = 0; p <= space.x.degree(); ++p)
      row[(y.first + q) * space.x.size() + x.first + p] =
          factor * x.values[static_cast<std::size_t>(p)] * y.values[static_cast<std::size_t>(q)];
  return row;
}

/// The fit by a dense least-squares solution of all coefficients with nothing taken off first: u and v at the points,
/// one after another.
Eigen::VectorXd dense_fit(const VectorObservations& o, const Rectangle& region, const FlowOptions& options) {
  const Energy energy = options.model == FlowModel::Slow ? Energy::thin_plate() : Energy::third_derivatives();
  const Hierarchy h(energy, region, options.degree);
  const auto& space = h.finest().space;
  std::vector<bool> parts = {options.model == FlowModel::Irrotational};
  if (options.model == FlowModel::General) parts = {false, true};
  const auto n = static_cast<Eigen::Index>(space.size()), rows = static_cast<Eigen::Index>(2 * o.size()),
             all = n * static_cast<Eigen::Index>(parts.size());
  Eigen::MatrixXd b(rows, all), e = Eigen::MatrixXd::Zero(all, all);
  Eigen::VectorXd z(rows), w(rows);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const auto i = static_cast<std::size_t>(row / 2);
    for (std::size_t k = 0; k < parts.size(); ++k)
      b.row(row).segment(static_cast<Eigen::Index>(k) * n, n) =
          dense_row(space, region.x.to_cells(o.x[i]), region.y.to_cells(o.y[i]), row % 2 == 1, parts[k]);
    z[row] = row % 2 == 0 ? o.u[i] : o.v[i];
    w[row] = o.weight[i];
  }
  w /= w.sum();
  const int nx = space.x.size();
  for (int a = 0; a < n; ++a)
    for (int c = 0; c < n; ++c) e(a, c) = h.finest().energy.entry(a % nx, a / nx, c % nx, c / nx);
  if (parts.size() == 2) e.bottomRightCorner(n, n) = options.ratio * e.topLeftCorner(n, n);
  const Eigen::MatrixXd system = options.smoothing.value * e + b.transpose() * w.asDiagonal() * b;
  return b * system.completeOrthogonalDecomposition().solve(b.transpose() * (w.asDiagonal() * z));
}

TEST(FlowFit, equals_a_dense_least_squares_solution) {
  const Rectangle small = {Interval(10, 13, 11), Interval(-1, 1, 9)};
  auto o = samples(small, 60, 4, [](double x, double y) {
    return Vector{std::sin(2 * x) + y * y, std::cos(x * y)};  // neither without divergence nor without rotation
  });
  test::Random random(8);
  for (std::size_t i = 0; i < o.size(); ++i) o.weight.push_back(0.5 + random());
  for (const auto model : {FlowModel::Smooth, FlowModel::Slow, FlowModel::Irrotational, FlowModel::General})
    for (const int degree : {3, 4, 5})
      for (const double lambda : {1e-2, 1e-5}) {
        if (model == FlowModel::General && degree > 3) continue;  // the dense solution takes long
        const FlowOptions options{.model = model,
                                  .ratio = 0.3,
                                  .degree = degree,
                                  .smoothing = Smoothing::fixed(lambda),
                                  .limits = {.accuracy = 1e-12}};
        const auto found = fit_flow(o, small, options);
        const auto expected = dense_fit(o, small, options);
        double square = 0, total = 0;
        for (std::size_t i = 0; i < o.size(); ++i) {
          const auto row = static_cast<Eigen::Index>(2 * i);
          EXPECT_NEAR(found.fitted_u[i], expected[row], 1e-8) << "degree " << degree << ", lambda " << lambda;
          EXPECT_NEAR(found.fitted_v[i], expected[row + 1], 1e-8);
          square += o.weight[i] * (std::pow(expected[row] - o.u[i], 2) + std::pow(expected[row + 1] - o.v[i], 2));
          total += o.weight[i];
        }
        EXPECT_NEAR(found.rms_residual, std::sqrt(square / total), 1e-8);
        if (found.field.stream()) {
          EXPECT_NEAR(mean_value(*found.field.stream()), 0, 1e-13);
        }
        if (found.field.potential()) {
          EXPECT_NEAR(mean_value(*found.field.potential()), 0, 1e-13);
        }
      }
}

TEST(FlowFit, interpolates_by_both_parts_at_less_energy_than_by_one) {
  const auto region = test::unit_square(20, 20);
  const auto o = samples(region, 40, 5, taylor_green);
  const auto both = fit_flow(o, region, {.model = FlowModel::General, .smoothing = Smoothing::none()});
  const auto one = fit_flow(o, region, {.smoothing = Smoothing::none()});
  EXPECT_LT(both.largest_residual, 1e-8);
  EXPECT_LT(one.largest_residual, 1e-8);
  EXPECT_LT(both.energy, one.energy);  // φ = 0 is allowed
  EXPECT_GT(both.potential_energy, 0);
}

TEST(FlowFit, gives_what_costs_nothing_to_the_stream_function) {
  const auto o = samples(wide, 40, 3, [](double x, double y) { return Vector{3 + x + 2 * y, 2 * x - y + 1}; });
  const auto fit = fit_flow(o, wide, {.model = FlowModel::General, .smoothing = Smoothing::fixed(1e-3)});
  for (const auto& [x, y] : {std::pair{10., -1.}, {11.3, 0.2}, {12.9, 0.8}}) {
    EXPECT_NEAR(fit.field.divergence(x, y), 0, 1e-9);
    EXPECT_NEAR(FlowField({}, fit.field.potential()).speed(x, y), 0, 1e-9);
  }
  // With X, Y from the centre of the region, ∇φ = ((1 - a) X, (1 + a) Y) has divergence 2; it is orthogonal to
  // ∇(X² - Y²) on 3 x 2 where 9 (1 - a) = 4 (1 + a).
  const auto p = samples(wide, 40, 3, [](double x, double y) { return Vector{x + y, y - x}; });
  const auto source = fit_flow(p, wide, {.model = FlowModel::General, .smoothing = Smoothing::fixed(1e-3)});
  const auto at = FlowField({}, source.field.potential()).velocity(12.5, 0.5);
  EXPECT_NEAR(at.u, 8. / 13, 1e-9);
  EXPECT_NEAR(at.v, 9. / 13, 1e-9);
  EXPECT_NEAR(source.energy, 0, 1e-15);
}

/// Weighted mean of a function over a segment, cut at the lines of the grid.
template <typename F>
double integral(const Interval& interval, double from, double to, F&& f) {
  static const GaussRule rule = gauss_rule(4);
  const double h = interval.finest_cell_length();
  double sum = 0;
  for (double left = from; left < to;) {
    const double next = interval.lower() + (std::floor((left - interval.lower()) / h + 1e-9) + 1) * h;
    const double right = std::min(next, to);
    for (std::size_t k = 0; k < 4; ++k)
      sum += (right - left) * rule.weight[k] * f(left + (right - left) * rule.place[k]);
    left = right;
  }
  return sum;
}

void expect_no_flux_through_boxes(const FlowField& field, unsigned seed) {
  test::Random random(seed);
  const auto &ix = field.region().x, &iy = field.region().y;
  for (int k = 0; k < 1000; ++k) {
    const double x0 = random() * 0.9, x1 = x0 + 0.02 + (0.98 - x0) * random(), y0 = random() * 0.9,
                 y1 = y0 + 0.02 + (0.98 - y0) * random();
    const auto across = [&](double y) {
      return Vector{integral(ix, x0, x1, [&](double x) { return field.velocity(x, y).v; }),
                    integral(ix, x0, x1, [&](double x) { return field.speed(x, y); })};
    };
    const auto along = [&](double x) {
      return Vector{integral(iy, y0, y1, [&](double y) { return field.velocity(x, y).u; }),
                    integral(iy, y0, y1, [&](double y) { return field.speed(x, y); })};
    };
    const auto low = across(y0), high = across(y1), left = along(x0), right = along(x1);
    ASSERT_LE(std::abs(high.u - low.u + right.u - left.u), 1e-12 * (low.v + high.v + left.v + right.v));
    // the flux through the right side is the difference of ψ
    ASSERT_NEAR(right.u, field.stream_function(x1, y1) - field.stream_function(x1, y0), 1e-13);
  }
}

TEST(FlowFit, of_taylor_green_samples_has_no_divergence_and_beats_components) {
  const auto region = test::unit_square(48, 48);
  for (const std::size_t n : {100, 400, 1600})
    for (const unsigned seed : {1, 2, 3, 4, 5}) {
      const auto o = samples(region, n, seed, taylor_green);
      const auto flow = fit_flow(o, region, {.smoothing = Smoothing::none()});
      const FitOptions options{.smoothing = Smoothing::none()};
      const auto u = fit_surface({o.x, o.y, o.u, {}, {}}, region, options);
      const auto v = fit_surface({o.x, o.y, o.v, {}, {}}, region, options);
      double ours = 0, components = 0, divergence = 0, gradient = 1e300;
      const double d = 1e-3 / 48;
      for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i) {
          const double x = (i + 0.5) / 40, y = (j + 0.5) / 40;
          const auto [u0, v0] = taylor_green(x, y);
          const auto at = flow.field.velocity(x, y);
          ours += std::pow(at.u - u0, 2) + std::pow(at.v - v0, 2);
          components += std::pow(u.solution.value(x, y) - u0, 2) + std::pow(v.solution.value(x, y) - v0, 2);
          const auto left = flow.field.velocity(x - d, y), right = flow.field.velocity(x + d, y);
          const auto low = flow.field.velocity(x, y - d), high = flow.field.velocity(x, y + d);
          divergence = std::max(divergence, std::abs(right.u - left.u + high.v - low.v) / (2 * d));
          gradient = std::min(gradient, std::hypot(std::hypot(right.u - left.u, right.v - left.v),
                                                   std::hypot(high.u - low.u, high.v - low.v)) /
                                            (2 * d));
        }
      EXPECT_LT(ours, components) << n << " points, seed " << seed;
      EXPECT_LE(divergence, 1e-6 * gradient) << n << " points, seed " << seed;
      EXPECT_LE(flow.largest_divergence, 1e-6);
      if (seed == 1) expect_no_flux_through_boxes(flow.field, seed);
    }
}

TEST(FlowFit, keeps_each_component_within_a_tolerance) {
  const auto region = test::unit_square(24, 24);
  auto o = samples(region, 80, 2, taylor_green);
  test::Random random(1);
  for (std::size_t i = 0; i < o.size(); ++i) o.u[i] += 0.05 * (random() - 0.5);
  for (const FlowModel model : {FlowModel::Smooth, FlowModel::General}) {
    const auto fit = fit_flow(o, region, {.model = model, .smoothing = Smoothing::within(0.03)});
    const auto close = fit_flow(o, region, {.model = model, .smoothing = Smoothing::none()});
    EXPECT_TRUE(fit.tolerance_reached);
    for (std::size_t i = 0; i < o.size(); ++i) {
      EXPECT_LE(std::abs(fit.fitted_u[i] - o.u[i]), 0.03);
      EXPECT_LE(std::abs(fit.fitted_v[i] - o.v[i]), 0.03);
    }
    EXPECT_LT(fit.energy, close.energy);
  }
}

TEST(FlowFit, finds_smoothing_for_noisy_vectors) {
  const auto region = test::unit_square(32, 32);
  auto o = samples(region, 400, 6, taylor_green);
  test::Random random(9);
  for (std::size_t i = 0; i < o.size(); ++i) {
    o.u[i] += 0.1 * random.normal();
    o.v[i] += 0.1 * random.normal();
  }
  const auto fit = fit_flow(o, region);
  // |v - v_i|² has the mean 2 · 0.01 less what the degrees of freedom take: 2 N = 800 rows
  ASSERT_TRUE(fit.effective_degrees.has_value());
  EXPECT_NEAR(fit.rms_residual, std::sqrt(2 * 0.01 * (1 - *fit.effective_degrees / 800)), 0.01);
  EXPECT_FALSE(fit.no_interior_minimum);
  double square = 0;
  for (std::size_t i = 0; i < o.size(); ++i) {
    const auto [u, v] = taylor_green(o.x[i], o.y[i]);
    square += std::pow(fit.fitted_u[i] - u, 2) + std::pow(fit.fitted_v[i] - v, 2);
  }
  EXPECT_LT(std::sqrt(square / 400), 0.05);  // of 0.141 in the data
}

TEST(FlowFit, leaves_out_and_merges_vectors) {
  const auto region = test::unit_square(8, 8);
  const VectorObservations o{{0.1, 0.9, 0.5, 0.5, 2, 0.3},
                             {0.1, 0.2, 0.8, 0.8, 0.5, 0.3},
                             {1, 2, 3, 5, 9, 9},
                             {0, 1, 0, 2, 9, 9},
                             {1, 1, 1, 3, 1, 0}};
  const auto fit = fit_flow(o, region, {.smoothing = Smoothing::none()});
  EXPECT_EQ(fit.points_outside, 1u);
  EXPECT_EQ(fit.points_merged, 1u);
  EXPECT_EQ(fit.points_used, 4u);
  EXPECT_NEAR(fit.fitted_u[2], 4.5, 1e-8);
  EXPECT_NEAR(fit.fitted_v[2], 1.5, 1e-8);
  EXPECT_TRUE(std::isnan(fit.fitted_u[4]));
}

TEST(FlowFit, of_both_parts_converges_as_fast_for_little_smoothing_as_for_much) {
  const auto region = test::unit_square(32, 32);
  auto o = samples(region, 300, 7, taylor_green);
  test::Random random(8);
  for (double& u : o.u) u += 0.1 * random.normal();
  for (const double lambda : {1., 1e-4, 1e-8, 1e-11, 1e-14}) {
    const auto fit = fit_flow(o, region, {.model = FlowModel::General, .smoothing = Smoothing::fixed(lambda)});
    EXPECT_LE(fit.iterations, 40) << "lambda " << lambda;
    EXPECT_LE(fit.accuracy, 1e-9);
  }
}

TEST(FlowFit, says_where_interpolation_misses_the_vectors) {
  // In one cell 16 functions live, and 60 components are asked for.
  const auto region = test::unit_square(12, 12);
  const Rectangle cell{Interval(0.5, 0.58, 2), Interval(0.5, 0.58, 2)};
  test::Random random(9);
  auto o = samples(cell, 30, 10, [&](double, double) { return Vector{random.normal(), random.normal()}; });
  const auto fit = fit_flow(o, region, {.smoothing = Smoothing::none()});
  EXPECT_GT(fit.largest_residual, 0.1);
  EXPECT_THAT(fit.notes, testing::Contains(HasSubstr("the field misses the vectors by up to")));
  const auto easy = fit_flow(samples(region, 30, 10, taylor_green), region, {.smoothing = Smoothing::none()});
  EXPECT_TRUE(easy.notes.empty());
}

TEST(FlowFit, says_what_is_wrong_in_one_line) {
  const auto region = test::unit_square(8, 8);
  const VectorObservations good = samples(region, 20, 1, taylor_green);
  const auto message = [&](auto&& change, FlowOptions options = {}) {
    auto o = good;
    change(o);
    return message_of<InvalidInput>([&] { fit_flow(o, region, options); });
  };
  const auto nothing = [](auto&) {};
  EXPECT_THAT(message([](auto& o) { o.v.pop_back(); }), HasSubstr("of one length, found 20, 20, 20, 19 and 0"));
  EXPECT_THAT(message([](auto& o) { o.u[4] = NAN; }), HasSubstr("at observation 5"));
  EXPECT_THAT(message([](auto& o) { o.weight.assign(20, -1); }), HasSubstr("weights that are not negative, found -1"));
  EXPECT_THAT(message([](auto& o) { o.weight.assign(20, 0); }), HasSubstr("found all 20 zero"));
  EXPECT_THAT(message([](auto& o) {
                for (double& x : o.x) x += 5;
              }),
              HasSubstr("found none of 20"));
  EXPECT_THAT(message([](auto& o) { o.y = o.x; }),
              HasSubstr("the model smooth needs three points that are not on one line, found 20 points on one line"));
  EXPECT_THAT(message(nothing, {.degree = 2}), HasSubstr("expected degree 3 to 5, found 2"));
  EXPECT_THAT(message(nothing, {.smoothing = Smoothing::fixed(-1)}), HasSubstr("not negative, found -1"));
  EXPECT_THAT(message(nothing, {.model = FlowModel::General, .ratio = 0}), HasSubstr("positive ratio"));
  EXPECT_THAT(message(nothing, {.smoothing = Smoothing::within(0)}), HasSubstr("positive tolerance, found 0"));
  const VectorObservations one{{0.5}, {0.5}, {1}, {2}, {}};
  EXPECT_THAT(message_of<InvalidInput>([&] { fit_flow(one, region); }), HasSubstr("found 1 point (the model slow"));
  EXPECT_NEAR(fit_flow(one, region, {.model = FlowModel::Slow}).field.velocity(0.1, 0.9).v, 2, 1e-12);
}

}  // namespace
}  // namespace batten
