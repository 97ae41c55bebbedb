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

/// Fitted u and v at the points by a dense least-squares solution among all splines that meet the constraints.
Eigen::VectorXd dense_fit(const VectorObservations& o, const Rectangle& region, const FlowOptions& options) {
  const Energy energy = options.model == FlowModel::Slow ? Energy::thin_plate() : Energy::third_derivatives();
  const Hierarchy h(energy, region, options.degree);
  const SplineSpace& space = h.finest().space;
  const Rows rows(space, options.model == FlowModel::Irrotational);
  const auto n = static_cast<Eigen::Index>(space.size());
  Eigen::FullPivLU<Eigen::MatrixXd> constraints(side_constraints(space, rows, options.sides));
  constraints.setThreshold(1e-10);
  const Eigen::MatrixXd kernel = constraints.kernel();
  Eigen::MatrixXd b(static_cast<Eigen::Index>(2 * o.size()), n), e(n, n);
  Eigen::VectorXd z(b.rows()), w(b.rows());
  for (Eigen::Index row = 0; row < b.rows(); ++row) {
    const auto i = static_cast<std::size_t>(row / 2);
    const bool is_v = row % 2 == 1;
    b.row(row) = rows.velocity(is_v, region.x.to_cells(o.x[i]), region.y.to_cells(o.y[i]));
    z[row] = is_v ? o.v[i] : o.u[i];
    w[row] = o.weight[i];
  }
  w /= w.sum();
  const int nx = space.x.size();
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) e(i, k) = h.finest().energy.entry(i % nx, i / nx, k % nx, k / nx);
  const Eigen::MatrixXd bk = b * kernel;
  const Eigen::MatrixXd system =
      options.smoothing.value * (kernel.transpose() * e * kernel) + bk.transpose() * w.asDiagonal() * bk;
  return bk * system.completeOrthogonalDecomposition().solve(bk.transpose() * (w.asDiagonal() * z));
}

const std::vector<FlowSides> plane_sides = {
    {Wall, Wall, Wall, Wall},           {NoSlip, Wall, Free, NoSlip},     {Wall, Free, Free, Free},
    {Free, Free, Wall, Wall},  // a channel: the flux is found
    {Free, Free, NoSlip, Wall},         {NoSlip, NoSlip, Free, Free},     {Periodic, Periodic, Free, Free},
    {Periodic, Periodic, Wall, NoSlip}, {Wall, Free, Periodic, Periodic}, {Periodic, Periodic, Periodic, Periodic}};

std::string name(const FlowSides& s) {
  std::string text;
  for (const FlowSide side : s.all()) text += "FWNP"[static_cast<int>(side)];
  return text;
}

TEST(FlowSides, fits_equal_dense_least_squares_under_constraints) {
  const Rectangle region{Interval(10, 13, 12), Interval(-1, 1, 12)};
  const auto o = wild(region, 60, 5);
  for (const FlowModel model : {FlowModel::Smooth, FlowModel::Slow, FlowModel::Irrotational})
    for (FlowSides sides : plane_sides) {
      const bool is_potential = model == FlowModel::Irrotational;
      for (FlowSide* side : {&sides.left, &sides.right, &sides.bottom, &sides.top})
        if (is_potential && *side == NoSlip) *side = Wall;
      const int degree = sides.left == Free ? 4 : 3;
      const FlowOptions options{.model = model,
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
  for (const FlowModel model : {FlowModel::Smooth, FlowModel::Slow}) {
    const auto field =
        fit_flow(o, region,
                 {.model = model, .sides = {NoSlip, Wall, Wall, NoSlip}, .smoothing = Smoothing::fixed(1e-6)})
            .field;
    for (int k = 0; k <= 50; ++k) {
      const double x = 2 * k / 50., y = k / 50.;
      EXPECT_LE(field.speed(0, y), 1e-12);
      EXPECT_LE(field.speed(x, 1), 1e-12);
      EXPECT_LE(std::abs(field.velocity(2, y).u), 1e-12);
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
  VectorObservations o = wild(region, 600, 9);
  for (std::size_t i = 0; i < o.size(); ++i) {
    o.u[i] = -2 + std::cos(2 * pi * o.x[i]);
    o.v[i] = 0;
  }
  const auto fit = fit_flow(o, region, {.model = FlowModel::Irrotational, .sides = {Periodic, Periodic, Wall, Wall}});
  EXPECT_NEAR(fit.mean_u.value(), -2, 1e-4);
  EXPECT_FALSE(fit.mean_v);
  for (int k = 0; k <= 20; ++k) EXPECT_NEAR(fit.field.velocity(k / 20., 1).v, 0, 1e-12);
}

TEST(FlowSides, that_contradict_each_other_or_the_model_are_refused) {
  const Rectangle region{Interval(0, 1, 16), Interval(0, 1, 16)};
  const auto o = wild(region, 50, 10);
  const auto message = [&](const FlowOptions& options) {
    return message_of<InvalidInput>([&] { fit_flow(o, region, options); });
  };
  EXPECT_THAT(message({.sides = {Periodic, Wall, Free, Free}}), HasSubstr("left and right"));
  EXPECT_THAT(message({.model = FlowModel::Irrotational, .sides = {NoSlip, Free, Free, Free}}), HasSubstr("slip"));
  EXPECT_THAT(message({.model = FlowModel::General, .sides = {Wall, Free, Free, Free}}), HasSubstr("general"));
  EXPECT_THAT(message({.sides = {Free, Free, Wall, Wall}, .smoothing = Smoothing::within(0.1)}),
              HasSubstr("tolerance"));
  EXPECT_NO_THROW(fit_flow(o, region, {.sides = {Wall, Free, Wall, Free}, .smoothing = Smoothing::within(2)}));
}

}  // namespace
}  // namespace batten
