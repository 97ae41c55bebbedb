// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/hierarchy.h>
#include <batten/flows/flow_fit.h>

#include "../support/message_of.h"
#include "../support/observations.h"
#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace batten {
namespace {

using testing::HasSubstr;
using enum FlowSide;

constexpr double pi = std::numbers::pi;

/// Noisy vectors without any structure of the sides.
VectorObservations wild(const Rectangle& region, std::size_t n, unsigned seed) {
  test::Random random(seed);
  VectorObservations o;
  for (std::size_t i = 0; i < n; ++i) {
    o.x.push_back(region.x.lower() + region.x.length() * random());
    o.y.push_back(region.y.lower() + region.y.length() * random());
    o.u.push_back(1 + random.normal());
    o.v.push_back(random.normal() - 0.5);
    o.weight.push_back(0.5 + random());
  }
  return o;
}

/// The functions of all splines of a space with their derivatives at one point, as a row.
class Rows {
public:
  Rows(const SplineSpace& space, bool is_potential) : space_(space), is_potential_(is_potential) {}

  /// ∂_x^a ∂_y^b p in the coordinates of the region over its longer side; s and t in cells.
  Eigen::RowVectorXd derivative(double s, double t, int a, int b) const {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(space_.size()));
    const auto x = space_.x.at(s, a), y = space_.y.at(t, b);
    const double factor = std::pow(space_.hx, -a) * std::pow(space_.hy, -b);
    for (int q = 0; q <= space_.y.degree(); ++q)
      for (int p = 0; p <= space_.x.degree(); ++p)
        row[(y.first + q) * space_.x.size() + x.first + p] =
            factor * x.values[static_cast<std::size_t>(p)] * y.values[static_cast<std::size_t>(q)];
    return row;
  }
  /// Of ∂_x^a ∂_y^b u, or of v.
  Eigen::RowVectorXd velocity(bool is_v, double s, double t, int a = 0, int b = 0) const {
    if (is_potential_) return derivative(s, t, a + (is_v ? 0 : 1), b + (is_v ? 1 : 0));
    return is_v ? Eigen::RowVectorXd(-derivative(s, t, a + 1, b)) : derivative(s, t, a, b + 1);
  }

private:
  const SplineSpace& space_;
  bool is_potential_;
};

/// What the velocities of the sides ask of all coefficients, C c = 0, from many places along each side.
Eigen::MatrixXd side_constraints(const SplineSpace& space, const Rows& rows, const FlowSides& sides) {
  std::vector<Eigen::RowVectorXd> found;
  const int nx = space.x.interval().cells(), ny = space.y.interval().cells(), d = space.x.degree();
  const auto along = [&](FlowSide side, bool is_horizontal, double at, double opposite) {
    const int cells = is_horizontal ? nx : ny;
    for (int k = 0; k <= cells * (d + 1); ++k) {
      const double r = k / (d + 1.);
      const auto row = [&](bool normal, double place, int order) {
        return is_horizontal ? rows.velocity(normal, r, place, 0, order) : rows.velocity(!normal, place, r, order, 0);
      };
      if (side == Wall || side == NoSlip) found.push_back(row(true, at, 0));
      if (side == NoSlip) found.push_back(row(false, at, 0));
      for (int order = 0; side == Periodic && order < d - 1; ++order)  // velocities have d - 2 continuous derivatives
        for (const bool normal : {true, false}) found.push_back(row(normal, at, order) - row(normal, opposite, order));
    }
  };
  along(sides.left, false, 0, nx);
  along(sides.right, false, nx, 0);
  along(sides.bottom, true, 0, ny);
  along(sides.top, true, ny, 0);
  Eigen::MatrixXd c(static_cast<Eigen::Index>(found.size()), static_cast<Eigen::Index>(space.size()));
  for (std::size_t i = 0; i < found.size(); ++i) c.row(static_cast<Eigen::Index>(i)) = found[i].normalized();
  return c;
}

/// The sides of one spline, ψ or φ, of a fit.
struct DensePart {
  DensePart(const Hierarchy& h, const FlowOptions& options, bool is_potential)
      : rows(h.finest().space, is_potential), space(h.finest().space) {
    Eigen::FullPivLU<Eigen::MatrixXd> constraints(side_constraints(space, rows, options.sides));
    constraints.setThreshold(1e-10);
    kernel = constraints.kernel();
    const int nx = space.x.size(), n = static_cast<int>(space.size());
    Eigen::MatrixXd e(n, n);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) e(i, k) = h.finest().energy.entry(i % nx, i / nx, k % nx, k / nx);
    energy =
        (is_potential && options.model == FlowModel::General ? options.ratio : 1) * (kernel.transpose() * e * kernel);
  }

  /// u and v at the points, one after another, of each function of the kernel.
  Eigen::MatrixXd velocities(const VectorObservations& o, const Rectangle& region) const {
    Eigen::MatrixXd b(static_cast<Eigen::Index>(2 * o.size()), static_cast<Eigen::Index>(space.size()));
    for (Eigen::Index row = 0; row < b.rows(); ++row) {
      const auto i = static_cast<std::size_t>(row / 2);
      b.row(row) = rows.velocity(row % 2 == 1, region.x.to_cells(o.x[i]), region.y.to_cells(o.y[i]));
    }
    return b * kernel;
  }

  Rows rows;
  const SplineSpace& space;
  Eigen::MatrixXd kernel, energy;
};

/// Fitted u and v at the points by a dense least-squares solution among all splines that meet the constraints.
Eigen::VectorXd dense_fit(const VectorObservations& o, const Rectangle& region, const FlowOptions& options) {
  const Energy energy = options.model == FlowModel::Slow ? Energy::thin_plate() : Energy::third_derivatives();
  const Hierarchy h(energy, region, options.degree);
  std::vector<DensePart> parts;
  if (options.model != FlowModel::Irrotational) parts.emplace_back(h, options, false);
  if (options.model == FlowModel::Irrotational || options.model == FlowModel::General)
    parts.emplace_back(h, options, true);
  Eigen::Index n = 0;
  for (const DensePart& part : parts) n += part.kernel.cols();
  Eigen::MatrixXd b(static_cast<Eigen::Index>(2 * o.size()), n), e = Eigen::MatrixXd::Zero(n, n);
  n = 0;
  for (const DensePart& part : parts) {
    const auto columns = part.kernel.cols();
    b.middleCols(n, columns) = part.velocities(o, region);
    e.block(n, n, columns, columns) = part.energy;
    n += columns;
  }
  Eigen::VectorXd z(b.rows()), w(b.rows());
  for (Eigen::Index row = 0; row < b.rows(); ++row) {
    const auto i = static_cast<std::size_t>(row / 2);
    z[row] = row % 2 == 1 ? o.v[i] : o.u[i];
    w[row] = o.weight[i];
  }
  w /= w.sum();
  const Eigen::MatrixXd system = options.smoothing.value * e + b.transpose() * w.asDiagonal() * b;
  return b * system.completeOrthogonalDecomposition().solve(b.transpose() * (w.asDiagonal() * z));
}

const std::vector<FlowSides> plane_sides = {
    {Wall, Wall, Wall, Wall},           {NoSlip, Wall, Free, NoSlip},      {Wall, Free, Free, Free},
    {Free, Free, Wall, Wall},  // a channel: the flux is found
    {Free, Free, NoSlip, Wall},         {NoSlip, NoSlip, Free, Free},      {Periodic, Periodic, Free, Free},
    {Periodic, Periodic, Wall, NoSlip}, {Wall, Free, Periodic, Periodic},  {Periodic, Periodic, Periodic, Periodic},
    {Periodic, Periodic, Free, Wall},   {Free, Wall, Wall, Free},          {Wall, Wall, Wall, Free},
    {Free, Wall, NoSlip, NoSlip},       {Periodic, Periodic, NoSlip, Free}};

std::string name(const FlowSides& s) {
  std::string text;
  for (const FlowSide side : s.all()) text += "FWNP"[static_cast<int>(side)];
  return text;
}

TEST(FlowSides, fits_equal_dense_least_squares_under_constraints) {
  const Rectangle region{Interval(10, 13, 10), Interval(-1, 1, 10)};
  const auto o = wild(region, 60, 5);
  for (const FlowModel model : {FlowModel::Smooth, FlowModel::Slow, FlowModel::Irrotational, FlowModel::General})
    for (FlowSides sides : plane_sides) {
      const bool has_slip = model == FlowModel::Irrotational || (model == FlowModel::General && !sides.have(Free));
      for (FlowSide* side : {&sides.left, &sides.right, &sides.bottom, &sides.top})
        if (has_slip && *side == NoSlip) *side = Wall;
      const int degree = sides.left == Free ? 4 : 3;
      const FlowOptions options{.model = model,
                                .ratio = 0.5,
                                .degree = degree,
                                .sides = sides,
                                .smoothing = Smoothing::fixed(model == FlowModel::Slow ? 1e-3 : 1e-5)};
      const auto fit = fit_flow(o, region, options);
      const auto expected = dense_fit(o, region, options);
      for (std::size_t i = 0; i < o.size(); ++i) {
        ASSERT_NEAR(fit.fitted_u[i], expected[static_cast<Eigen::Index>(2 * i)], 2e-8) << name(sides);
        ASSERT_NEAR(fit.fitted_v[i], expected[static_cast<Eigen::Index>(2 * i + 1)], 2e-8) << name(sides);
      }
    }
}

TEST(FlowSides, nothing_flows_through_walls_and_nothing_moves_where_there_is_no_slip) {
  const Rectangle region{Interval(0, 2, 48), Interval(0, 1, 24)};
  const auto o = wild(region, 200, 6);
  for (const FlowModel model : {FlowModel::Smooth, FlowModel::Slow, FlowModel::General}) {
    const bool is_general = model == FlowModel::General;  // which needs a free side
    const auto field = fit_flow(o, region,
                                {.model = model,
                                 .sides = {NoSlip, is_general ? Free : Wall, Wall, NoSlip},
                                 .smoothing = Smoothing::fixed(1e-6)})
                           .field;
    for (int k = 0; k <= 50; ++k) {
      const double x = 2 * k / 50., y = k / 50.;
      EXPECT_LE(field.speed(0, y), 1e-12);
      EXPECT_LE(field.speed(x, 1), 1e-12);
      EXPECT_LE(is_general ? 0 : std::abs(field.velocity(2, y).u), 1e-12);
      EXPECT_LE(std::abs(field.velocity(x, 0).v), 1e-12);
    }
    EXPECT_GT(field.speed(2, 0.5), 1e-3);
  }
}

TEST(FlowSides, the_flux_of_a_channel_is_found) {
  // Poiseuille flow, u = 6 y (1 - y) and of flux 1, and its transpose, upwards.
  const Rectangle region{Interval(0, 1, 32), Interval(0, 1, 32)};
  VectorObservations o = wild(region, 300, 7), turned = o;
  for (std::size_t i = 0; i < o.size(); ++i) {
    o.u[i] = turned.v[i] = 6 * o.y[i] * (1 - o.y[i]);
    o.v[i] = turned.u[i] = 0;
  }
  std::swap(turned.x, turned.y);
  for (const FlowSide wall : {Wall, NoSlip}) {
    const auto fit = fit_flow(o, region, {.sides = {Free, Free, wall, wall}, .smoothing = Smoothing::none()});
    EXPECT_NEAR(fit.flux.value(), 1, 2e-4);  // E wants less of ψ_yyy = -12 where no vector forbids it
    EXPECT_LE(fit.rms_residual, 1e-6);
    const auto up = fit_flow(turned, region, {.sides = {wall, wall, Free, Free}, .smoothing = Smoothing::none()});
    EXPECT_NEAR(up.flux.value(), fit.flux.value(), 1e-6);
  }
  EXPECT_FALSE(fit_flow(o, region, {.sides = {Wall, Wall, Wall, Wall}}).flux);
  EXPECT_FALSE(fit_flow(o, region, {.sides = {Wall, Free, Wall, Free}}).flux);
}

TEST(FlowSides, mean_flows_and_eddies_go_on_around_a_torus) {
  const Rectangle region{Interval(0, 2, 64), Interval(0, 1, 32)};
  const auto exact = [](double x, double y) { return std::pair{3 + std::sin(2 * pi * y), 0.25 + std::cos(pi * x)}; };
  VectorObservations o = wild(region, 1500, 8);
  for (std::size_t i = 0; i < o.size(); ++i) std::tie(o.u[i], o.v[i]) = exact(o.x[i], o.y[i]);
  const auto fit = fit_flow(o, region, {.sides = {Periodic, Periodic, Periodic, Periodic}});
  EXPECT_NEAR(fit.mean_u.value(), 3, 1e-4);
  EXPECT_NEAR(fit.mean_v.value(), 0.25, 1e-4);
  EXPECT_LE(fit.rms_residual, 2e-4);
  for (int k = 0; k <= 20; ++k) {
    const double x = k / 10., y = k / 20.;
    EXPECT_NEAR(fit.field.velocity(x, 0).v, fit.field.velocity(x, 1).v, 1e-10);
    EXPECT_NEAR(fit.field.vorticity(0, y), fit.field.vorticity(2, y), 1e-9);
    EXPECT_NEAR(fit.field.velocity(x, y).u, exact(x, y).first, 2e-3);
  }
}

TEST(FlowSides, a_gradient_that_is_periodic_has_a_mean_flow_as_well) {
  const Rectangle region{Interval(0, 1, 32), Interval(0, 1, 32)};
  for (const unsigned seed : {9u, 10u, 11u}) {
    VectorObservations o = wild(region, 600, seed);
    for (std::size_t i = 0; i < o.size(); ++i) {
      o.u[i] = -2 + std::cos(2 * pi * o.x[i]);
      o.v[i] = 0;
    }
    const auto fit = fit_flow(o, region, {.model = FlowModel::Irrotational, .sides = {Periodic, Periodic, Wall, Wall}});
    EXPECT_NEAR(fit.mean_u.value(), -2, 1e-4);
    EXPECT_FALSE(fit.mean_v);
    for (int k = 0; k <= 20; ++k) EXPECT_NEAR(fit.field.velocity(k / 20., 1).v, 0, 1e-12);
  }
}

TEST(FlowSides, nothing_flows_through_walls_around_sources_and_eddies) {
  // u = sin πx cos πy + sin πx, v = -cos πx sin πy + 3 sin 2πy / 2, which no rotation alone can do.
  const Rectangle region{Interval(0, 1, 32), Interval(0, 1, 32)};
  VectorObservations o = wild(region, 500, 11);
  for (std::size_t i = 0; i < o.size(); ++i) {
    const double x = pi * o.x[i], y = pi * o.y[i];
    o.u[i] = std::sin(x) * std::cos(y) + std::sin(x);
    o.v[i] = -std::cos(x) * std::sin(y) + 1.5 * std::sin(2 * y);
  }
  const auto fit = fit_flow(
      o, region, {.model = FlowModel::General, .sides = {Wall, Wall, Wall, Wall}, .smoothing = Smoothing::none()});
  EXPECT_LE(fit.largest_residual, 1e-7);
  EXPECT_FALSE(fit.flux || fit.mean_u || fit.mean_v);
  for (int k = 0; k <= 50; ++k) {
    EXPECT_LE(std::abs(fit.field.velocity(0, k / 50.).u), 1e-12);
    EXPECT_LE(std::abs(fit.field.velocity(1, k / 50.).u), 1e-12);
    EXPECT_LE(std::abs(fit.field.velocity(k / 50., 0).v), 1e-12);
    EXPECT_LE(std::abs(fit.field.velocity(k / 50., 1).v), 1e-12);
    EXPECT_NEAR(fit.field.divergence(0.5, k / 50.), 3 * pi * std::cos(2 * pi * k / 50.), 0.1);
  }
}

TEST(FlowSides, the_mean_flux_of_a_channel_with_sources_is_found) {
  // u = 6 y (1 - y) (1 + x / 5): the flux grows from 1 to 1.2.
  const Rectangle region{Interval(0, 1, 32), Interval(0, 1, 32)};
  VectorObservations o = wild(region, 300, 12), turned = o;
  for (std::size_t i = 0; i < o.size(); ++i) {
    o.u[i] = turned.v[i] = 6 * o.y[i] * (1 - o.y[i]) * (1 + o.x[i] / 5);
    o.v[i] = turned.u[i] = 0;
  }
  std::swap(turned.x, turned.y);
  for (const FlowSide wall : {Wall, NoSlip}) {
    const FlowOptions along_x{
        .model = FlowModel::General, .sides = {Free, Free, wall, wall}, .smoothing = Smoothing::none()};
    EXPECT_NEAR(fit_flow(o, region, along_x).flux.value(), 1.1, 2e-3);
    const FlowOptions along_y{
        .model = FlowModel::General, .sides = {wall, wall, Free, Free}, .smoothing = Smoothing::none()};
    EXPECT_NEAR(fit_flow(turned, region, along_y).flux.value(), 1.1, 2e-3);
  }
}

TEST(FlowSides, mean_flows_with_sources_and_eddies_go_on_around_a_torus) {
  const Rectangle region{Interval(0, 2, 64), Interval(0, 1, 32)};
  VectorObservations o = wild(region, 1500, 13);
  for (std::size_t i = 0; i < o.size(); ++i) {
    o.u[i] = 3 + std::sin(2 * pi * o.y[i]) + std::sin(pi * o.x[i]);
    o.v[i] = 0.25 + std::cos(pi * o.x[i]);
  }
  for (const FlowSide across : {Periodic, Free}) {
    const auto fit = fit_flow(o, region,
                              {.model = FlowModel::General,
                               .sides = {Periodic, Periodic, across, across},
                               .smoothing = Smoothing::fixed(1e-9)});
    EXPECT_NEAR(fit.mean_u.value(), 3, 1e-3);
    EXPECT_NEAR(fit.mean_v.value(), 0.25, 1e-3);
    EXPECT_LE(fit.rms_residual, 1e-3);
    for (int k = 0; k <= 20; ++k)
      EXPECT_NEAR(fit.field.velocity(0, k / 20.).v, fit.field.velocity(2, k / 20.).v, 1e-10);
  }
}

TEST(FlowSides, a_tolerance_is_kept_where_a_flux_or_a_mean_flow_is_found) {
  const Rectangle region{Interval(0, 1, 24), Interval(0, 1, 24)};
  VectorObservations o = wild(region, 100, 14);
  test::Random random(15);
  for (std::size_t i = 0; i < o.size(); ++i) {
    o.u[i] = 6 * o.y[i] * (1 - o.y[i]) + 0.05 * (random() - 0.5);
    o.v[i] = 0.05 * (random() - 0.5);
  }
  for (const FlowSides sides : {FlowSides{Free, Free, NoSlip, Wall}, FlowSides{Periodic, Periodic, Wall, Wall}}) {
    const auto fit = fit_flow(o, region, {.sides = sides, .smoothing = Smoothing::within(0.03)});
    EXPECT_TRUE(fit.tolerance_reached);
    for (std::size_t i = 0; i < o.size(); ++i) {
      EXPECT_LE(std::abs(fit.fitted_u[i] - o.u[i]), 0.03);
      EXPECT_LE(std::abs(fit.fitted_v[i] - o.v[i]), 0.03);
    }
    EXPECT_NEAR(fit.flux.value(), 1, 0.03);  // that of a mean velocity within the tolerance
    EXPECT_LT(fit.energy, fit_flow(o, region, {.sides = sides, .smoothing = Smoothing::none()}).energy);
  }
}

TEST(FlowSides, that_contradict_each_other_or_the_model_are_refused) {
  const Rectangle region{Interval(0, 1, 16), Interval(0, 1, 16)};
  const auto o = wild(region, 50, 10);
  const auto message = [&](const FlowOptions& options) {
    return message_of<InvalidInput>([&] { fit_flow(o, region, options); });
  };
  EXPECT_THAT(message({.sides = {Periodic, Wall, Free, Free}}), HasSubstr("left and right"));
  EXPECT_THAT(message({.model = FlowModel::Irrotational, .sides = {NoSlip, Free, Free, Free}}), HasSubstr("slip"));
  EXPECT_THAT(message({.model = FlowModel::General, .sides = {NoSlip, Wall, Periodic, Periodic}}),
              HasSubstr("expected a free side for the model general with walls without slip"));
}

}  // namespace
}  // namespace batten
