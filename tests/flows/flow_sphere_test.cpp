// SPDX-License-Identifier: MIT
#include <batten/bases/gauss_rule.h>
#include <batten/domains/errors.h>
#include <batten/fem/hierarchy.h>
#include <batten/flows/divergence_share.h>
#include <batten/flows/flow_fit.h>
#include <batten/flows/stream_extremes.h>
#include <batten/flows/streamlines.h>

#include "../support/laws.h"
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

constexpr double degree = std::numbers::pi / 180;
const Rectangle europe = {Interval(-12, 30, 14), Interval(34, 62, 12)};

/// The unit vectors up, to the east and to the north.
struct Frame {
  Eigen::Vector3d up, east, north;

  Frame(double x, double y) {
    const double l = x * degree, p = y * degree;
    up = {std::cos(p) * std::cos(l), std::cos(p) * std::sin(l), std::sin(p)};
    east = {-std::sin(l), std::cos(l), 0};
    north = up.cross(east);
  }
};

/// A rotation of the Earth about a tilted axis, velocity axis × position; its vorticity is 2 axis · up.
struct Rotation {
  Eigen::Vector3d axis = {0.002, -0.001, 0.0015};

  FlowField::Velocity velocity(double x, double y) const {
    const Frame at(x, y);
    const Eigen::Vector3d v = axis.cross(earth_radius * at.up);
    return {v.dot(at.east), v.dot(at.north)};
  }
  double vorticity(double x, double y) const { return 2 * axis.dot(Frame(x, y).up); }
};

VectorObservations places(const Rectangle& region, std::size_t n, unsigned seed) {
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

VectorObservations samples_of(const Rotation& rotation, const Rectangle& region, std::size_t n) {
  VectorObservations o = places(region, n, 3);
  for (std::size_t i = 0; i < n; ++i) {
    const auto [u, v] = rotation.velocity(o.x[i], o.y[i]);
    o.u[i] = u;
    o.v[i] = v;
  }
  return o;
}

FlowField random_field(const Rectangle& region, bool has_stream, bool has_potential) {
  const auto spline = [&](unsigned seed) {
    const auto size = static_cast<std::size_t>((region.x.cells() + 4) * (region.y.cells() + 4));
    return Solution(region, 4, test::random_vector(size, seed));
  };
  std::optional<Solution> stream, potential;
  if (has_stream) stream = spline(1);
  if (has_potential) potential = spline(2);
  return FlowField(std::move(stream), std::move(potential), FlowGeometry::sphere());
}

/// What leaves a box of longitudes and latitudes, the circulation around it, and the size of both.
struct Balance {
  double outflow = 0, circulation = 0, size = 0;

  Balance(const FlowField& field, double west, double east, double south, double north) {
    const GaussRule rule = gauss_rule(6);
    constexpr int parts = 60;
    for (int k = 0; k < parts; ++k)
      for (std::size_t q = 0; q < rule.place.size(); ++q) {
        const double share = (k + rule.place[q]) / parts;
        const double x = west + share * (east - west), y = south + share * (north - south);
        const double along_y = rule.weight[q] / parts * (north - south) * degree * earth_radius;
        const auto along_x = [&](double at) {
          return rule.weight[q] / parts * (east - west) * degree * earth_radius * std::cos(at * degree);
        };
        const auto w = field.velocity(west, y), e = field.velocity(east, y);
        const auto s = field.velocity(x, south), n = field.velocity(x, north);
        outflow += (e.u - w.u) * along_y + n.v * along_x(north) - s.v * along_x(south);
        circulation += (e.v - w.v) * along_y - n.u * along_x(north) + s.u * along_x(south);
        size += (std::hypot(e.u, e.v) + std::hypot(w.u, w.v)) * along_y + std::hypot(n.u, n.v) * along_x(north) +
                std::hypot(s.u, s.v) * along_x(south);
      }
  }
};

/// ∫∫ of divergence and vorticity over a box of one cell.
std::pair<double, double> integrals(const FlowField& field, double west, double east, double south, double north) {
  const GaussRule rule = gauss_rule(8);
  double divergence = 0, vorticity = 0;
  for (std::size_t p = 0; p < rule.place.size(); ++p)
    for (std::size_t q = 0; q < rule.place.size(); ++q) {
      const double x = west + rule.place[p] * (east - west), y = south + rule.place[q] * (north - south);
      const double area = rule.weight[p] * rule.weight[q] * (east - west) * (north - south) *
                          std::pow(degree * earth_radius, 2) * std::cos(y * degree);
      divergence += area * field.divergence(x, y);
      vorticity += area * field.vorticity(x, y);
    }
  return {divergence, vorticity};
}

TEST(FlowOnASphere, keeps_the_theorems_of_gauss_and_stokes) {
  const FlowField field = random_field(europe, true, true);
  for (int k = 0; k < 14; ++k) {
    const double west = -12 + 3 * k, south = 34 + 28 / 12. * (k % 12);  // within one cell
    const double east = west + 3, north = std::min(south + 28 / 12., 62.);
    const Balance balance(field, west, east, south, north);
    const auto [divergence, vorticity] = integrals(field, west, east, south, north);
    EXPECT_NEAR(balance.outflow, divergence, 1e-10 * balance.size);
    EXPECT_NEAR(balance.circulation, vorticity, 1e-10 * balance.size);
  }
}

TEST(FlowOnASphere, of_a_stream_function_has_no_divergence_and_of_a_potential_no_vorticity) {
  const FlowField rotation = random_field(europe, true, false), gradient = random_field(europe, false, true);
  test::Random random(5);
  for (int k = 0; k < 20; ++k) {
    const double west = -12 + 20 * random(), east = west + 20 * random();
    const double south = 34 + 14 * random(), north = south + 13 * random();
    // The rule meets kinks of v'' at knots: 60 parts of Gauss's order 12.
    const Balance one(rotation, west, east, south, north), two(gradient, west, east, south, north);
    EXPECT_LE(std::abs(one.outflow), 1e-7 * one.size);
    EXPECT_LE(std::abs(two.circulation), 1e-7 * two.size);
    EXPECT_EQ(rotation.divergence(west, south), 0);
    EXPECT_EQ(gradient.vorticity(west, south), 0);
    // The flux through a meridian, from its west to its east, is the fall of ψ along it.
    const double fall = rotation.stream_function(west, south) - rotation.stream_function(west, north);
    const GaussRule rule = gauss_rule(6);
    double flux = 0;
    for (int part = 0; part < 60; ++part)
      for (std::size_t q = 0; q < 6; ++q)
        flux += rule.weight[q] / 60 * (north - south) * degree * earth_radius *
                rotation.velocity(west, south + (part + rule.place[q]) / 60 * (north - south)).u;
    EXPECT_NEAR(flux, fall, 1e-7 * one.size);
  }
}

TEST(FlowOnASphere, has_derivatives_by_length) {
  const FlowField field = random_field(europe, true, true);
  const double d = 1e-4;  // degrees; the second differences of v make errors of d²
  for (const auto& [x, y] : {std::pair{-10.7, 35.1}, {3.3, 50.}, {28.9, 60.5}}) {
    const double width = 2 * d * degree * earth_radius * std::cos(y * degree), height = 2 * d * degree * earth_radius;
    const auto w = field.velocity(x - d, y), e = field.velocity(x + d, y);
    const auto s = field.velocity(x, y - d), n = field.velocity(x, y + d);
    const auto g = field.gradient(x, y);
    const double size = std::abs(g.u_x) + std::abs(g.u_y) + std::abs(g.v_x) + std::abs(g.v_y);
    EXPECT_NEAR(g.u_x, (e.u - w.u) / width, 1e-6 * size);
    EXPECT_NEAR(g.v_x, (e.v - w.v) / width, 1e-6 * size);
    EXPECT_NEAR(g.u_y, (n.u - s.u) / height, 1e-6 * size);
    EXPECT_NEAR(g.v_y, (n.v - s.v) / height, 1e-6 * size);
    const auto [u, v] = field.velocity(x, y);
    const double bend = std::tan(y * degree) / earth_radius;
    EXPECT_NEAR(field.divergence(x, y), g.u_x + g.v_y - v * bend, 1e-12 * size);
    EXPECT_NEAR(field.vorticity(x, y), g.v_x - g.u_y + u * bend, 1e-12 * size);
  }
}

TEST(FlowOnASphere, has_samples_of_itself_and_survives_a_record) {
  const FlowField field = random_field(europe, true, true), again = FlowField::from_record(field.to_record());
  EXPECT_EQ(again.geometry(), field.geometry());
  EXPECT_EQ(again.velocity(1, 50).v, field.velocity(1, 50).v);
  const GridSamples s = field.samples();
  for (const auto& array : s.arrays)
    for (int j = 0; j < s.points[1]; ++j)
      for (int i = 0; i < s.points[0]; ++i) {
        const double x = europe.x.coordinate(i), y = europe.y.coordinate(j);
        const auto k = static_cast<std::size_t>(i + s.points[0] * j);
        const double found = array.values[array.name == "velocity" ? 3 * k : k];
        const double expected = array.name == "velocity"          ? field.velocity(x, y).u
                                : array.name == "divergence"      ? field.divergence(x, y)
                                : array.name == "vorticity"       ? field.vorticity(x, y)
                                : array.name == "speed"           ? field.speed(x, y)
                                : array.name == "stream_function" ? field.stream_function(x, y)
                                                                  : field.potential()->value(x, y);
        ASSERT_NEAR(found, expected, 1e-13) << array.name;
      }
}

TEST(FlowOnASphere, a_rotation_about_a_tilted_axis_is_found) {
  const Rotation rotation;
  const Rectangle region{Interval(-12, 30, 24), Interval(34, 62, 24)};
  const auto o = samples_of(rotation, region, 1500);
  for (const FlowModel model : {FlowModel::Smooth, FlowModel::General}) {
    const double lambda = model == FlowModel::General ? 1e-7 : 1e-11;
    const auto fit = fit_flow(o, region, {.model = model, .geographic = true, .smoothing = Smoothing::fixed(lambda)});
    for (int k = 0; k <= 100; ++k) {
      const double x = -10 + 38 * (k % 11) / 10., y = 36 + 24 * (k / 11) / 10.;
      const auto [u, v] = rotation.velocity(x, y);  // up to 17; General has to find φ = 0
      const double part = model == FlowModel::General ? 1e-3 : 1e-4;
      EXPECT_NEAR(fit.field.velocity(x, y).u, u, 17 * part) << x << ' ' << y;
      EXPECT_NEAR(fit.field.velocity(x, y).v, v, 17 * part) << x << ' ' << y;
      EXPECT_NEAR(fit.field.vorticity(x, y), rotation.vorticity(x, y), 30 * part * rotation.axis.norm());
    }
    if (model != FlowModel::Smooth) continue;
    EXPECT_LE(fit.largest_divergence, 1e-6);
    EXPECT_EQ(divergence_share(fit.field), fit.largest_divergence);
    // ψ is -R² axis · up and a constant.
    const auto psi = [&](double x, double y) {
      return -earth_radius * earth_radius * rotation.axis.dot(Frame(x, y).up);
    };
    EXPECT_NEAR(fit.field.stream_function(25, 60) - fit.field.stream_function(-10, 35), psi(25, 60) - psi(-10, 35),
                1e-4 * earth_radius * 17);
  }
}

/// Rows of u and v at a point in all coefficients of ψ or φ, in coordinates where the longer side is 1.
std::array<Eigen::RowVectorXd, 2> rows(const SplineSpace& space, const Rectangle& region, bool is_potential, double x,
                                       double y) {
  std::array<Eigen::RowVectorXd, 2> slope;
  for (const int k : {0, 1}) {
    auto& row = slope[static_cast<std::size_t>(k)] = Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(space.size()));
    const auto nx = space.x.at(region.x.to_cells(x), k == 0 ? 1 : 0);
    const auto ny = space.y.at(region.y.to_cells(y), k == 0 ? 0 : 1);
    for (int q = 0; q <= space.y.degree(); ++q)
      for (int p = 0; p <= space.x.degree(); ++p)
        row[(ny.first + q) * space.x.size() + nx.first + p] = nx.values[static_cast<std::size_t>(p)] *
                                                              ny.values[static_cast<std::size_t>(q)] /
                                                              (k == 0 ? space.hx : space.hy);
  }
  const double middle = (region.y.lower() + region.y.upper()) / 2;
  const double stretch = std::cos(middle * degree) / std::cos(y * degree);
  if (is_potential) return {stretch * slope[0], slope[1]};
  return {slope[1], -stretch * slope[0]};
}

/// Fitted u and v by a dense least-squares solution.
Eigen::VectorXd dense_fit(const VectorObservations& o, const Rectangle& region, const FlowOptions& options) {
  const Energy energy = options.model == FlowModel::Slow ? Energy::thin_plate() : Energy::third_derivatives();
  const double middle = (region.y.lower() + region.y.upper()) / 2;
  const Hierarchy h(energy, region, options.degree, {1 / std::cos(middle * degree)});
  const SplineSpace& space = h.finest().space;
  const auto n = static_cast<Eigen::Index>(space.size());
  const bool is_general = options.model == FlowModel::General, is_potential = options.model == FlowModel::Irrotational;
  const Eigen::Index all = is_general ? 2 * n : n;
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(2 * o.size()), all);
  Eigen::MatrixXd e = Eigen::MatrixXd::Zero(all, all);
  Eigen::VectorXd z(b.rows()), w(b.rows());
  for (Eigen::Index row = 0; row < b.rows(); ++row) {
    const auto i = static_cast<std::size_t>(row / 2), k = static_cast<std::size_t>(row % 2);
    b.row(row).head(n) = rows(space, region, is_potential, o.x[i], o.y[i])[k];
    if (is_general) b.row(row).tail(n) = rows(space, region, true, o.x[i], o.y[i])[k];
    z[row] = k == 1 ? o.v[i] : o.u[i];
    w[row] = o.weight[i];
  }
  w /= w.sum();
  const int nx = space.x.size();
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      e(i, k) = h.finest().energy.entry(i % nx, i / nx, k % nx, k / nx);
      if (is_general) e(n + i, n + k) = options.ratio * e(i, k);
    }
  const Eigen::MatrixXd system = options.smoothing.value * e + b.transpose() * w.asDiagonal() * b;
  return b * system.completeOrthogonalDecomposition().solve(b.transpose() * (w.asDiagonal() * z));
}

TEST(FlowOnASphere, fits_equal_dense_least_squares) {
  const Rectangle region{Interval(5, 31, 10), Interval(51, 75, 11)};
  const auto o = places(region, 60, 6);
  for (const FlowModel model : {FlowModel::Smooth, FlowModel::Slow, FlowModel::Irrotational, FlowModel::General}) {
    const double lambda = model == FlowModel::Slow ? 1e-3 : 1e-5;
    const FlowOptions options{.model = model, .ratio = 2, .geographic = true, .smoothing = Smoothing::fixed(lambda)};
    const auto fit = fit_flow(o, region, options);
    const auto expected = dense_fit(o, region, options);
    for (std::size_t i = 0; i < o.size(); ++i) {
      ASSERT_NEAR(fit.fitted_u[i], expected[static_cast<Eigen::Index>(2 * i)], 1e-7) << static_cast<int>(model);
      ASSERT_NEAR(fit.fitted_v[i], expected[static_cast<Eigen::Index>(2 * i + 1)], 1e-7) << static_cast<int>(model);
    }
  }
}

TEST(FlowOnASphere, general_converges_on_regions_of_every_size) {
  for (const double size : {0.01, 1., 40.}) {
    const Rectangle region{Interval(10, 10 + size, 24), Interval(45, 45 + size, 32)};
    const auto o = places(region, 300, 7);
    const auto fit =
        fit_flow(o, region, {.model = FlowModel::General, .geographic = true, .smoothing = Smoothing::fixed(1e-6)});
    EXPECT_LE(fit.accuracy, 1e-8) << size;
    EXPECT_LE(fit.iterations, 100) << size;
  }
}

TEST(FlowOnASphere, general_passes_through_vectors_where_rounding_hides_pairs) {
  // On a conformal map ψ and φ that are conjugate cancel, and the smoothest of them have next to no energy.
  for (const auto& [vectors, nx, ny] : {std::tuple{20, 16, 20}, {480, 48, 60}}) {
    const Rectangle region{Interval(-10, 10, nx), Interval(45, 60, ny)};
    const auto o = places(region, vectors, 7);
    const auto fit =
        fit_flow(o, region, {.model = FlowModel::General, .geographic = true, .smoothing = Smoothing::fixed(1e-14)});
    for (std::size_t i = 0; i < o.size(); ++i)
      EXPECT_LE(std::hypot(fit.fitted_u[i] - o.u[i], fit.fitted_v[i] - o.v[i]), 1e-3) << vectors;
  }
}

TEST(FlowOnASphere, keeps_velocities_within_a_tolerance) {
  const auto o = samples_of(Rotation{}, europe, 100);
  for (const FlowModel model : {FlowModel::Smooth, FlowModel::Irrotational}) {
    // A rotation is no gradient, but 14 x 12 cells bend one to within a third of its speed at 100 points.
    const double tolerance = model == FlowModel::Smooth ? 0.01 : 6;
    const auto fit =
        fit_flow(o, europe, {.model = model, .geographic = true, .smoothing = Smoothing::within(tolerance)});
    EXPECT_TRUE(fit.tolerance_reached);
    for (std::size_t i = 0; i < o.size(); ++i) {
      EXPECT_LE(std::abs(fit.fitted_u[i] - o.u[i]), tolerance);
      EXPECT_LE(std::abs(fit.fitted_v[i] - o.v[i]), tolerance);
    }
  }
}

TEST(FlowOnASphere, goes_around_a_full_circle) {
  // Zonal wind of 10 at all latitudes, and an eddy with two crests: ψ = 1000 cos y sin 2x.
  const Rectangle region{Interval(0, 360, 64), Interval(-60, 60, 32)};
  VectorObservations o = places(region, 1200, 8);
  const auto exact = [](double x, double y) {
    const double l = x * degree, p = y * degree;
    return std::pair{10 + 1000 * std::sin(p) * std::sin(2 * l) / earth_radius * 10,
                     2 * 1000 * std::cos(2 * l) / earth_radius * 10};
  };
  for (std::size_t i = 0; i < o.size(); ++i) std::tie(o.u[i], o.v[i]) = exact(o.x[i], o.y[i]);
  const auto fit = fit_flow(o, region,
                            {.geographic = true,
                             .sides = {FlowSide::Periodic, FlowSide::Periodic, FlowSide::Free, FlowSide::Free},
                             .smoothing = Smoothing::fixed(1e-9)});
  EXPECT_NEAR(fit.mean_v.value(), 0, 1e-3);
  for (int k = 0; k <= 20; ++k) {
    const double x = 18 * k, y = -55 + 5.5 * k;
    EXPECT_NEAR(fit.field.velocity(x, y).u, exact(x, y).first, 2e-2);
    EXPECT_NEAR(fit.field.velocity(x, y).v, exact(x, y).second, 2e-2);
    EXPECT_NEAR(fit.field.velocity(0, y).v, fit.field.velocity(360, y).v, 1e-9);
    EXPECT_NEAR(fit.field.vorticity(0, y), fit.field.vorticity(360, y), 1e-9);
  }
}

/// ψ as a spline of degree 5 near that of a rotation: the fit without smoothing.
FlowField rotation_field(const Rotation& rotation, const Rectangle& region) {
  return fit_flow(samples_of(rotation, region, 1500), region,
                  {.degree = 5, .geographic = true, .smoothing = Smoothing::fixed(1e-14)})
      .field;
}

TEST(FlowOnASphere, streamlines_of_a_rotation_are_circles_of_the_right_time) {
  // The axis leaves the Earth at (10, 50).
  const Rotation rotation{0.001 * Frame(10, 50).up};
  const FlowField field = rotation_field(rotation, {Interval(-10, 30, 32), Interval(38, 62, 32)});
  const auto line = StreamlineTracer(field).trace(10, 56);
  ASSERT_TRUE(line.closed());
  for (std::size_t i = 0; i < line.x.size(); ++i)
    EXPECT_NEAR(std::acos(Frame(line.x[i], line.y[i]).up.dot(Frame(10, 50).up)) / degree, 6, 1e-3);
  EXPECT_NEAR(line.time.back(), 2 * std::numbers::pi / 0.001, 1);
  const auto extremes = stream_extremes(field);  // counterclockwise about the least
  EXPECT_NEAR(extremes.least.x, 10, 1e-3);
  EXPECT_NEAR(extremes.least.y, 50, 1e-3);
}

TEST(FlowOnASphere, refuses_regions_that_are_none_of_a_sphere) {
  const auto message = [](double x, double south, double north, FlowSides sides = {}) {
    const Rectangle region{Interval(0, x, 8), Interval(south, north, 8)};
    const auto o = places(region, 20, 9);
    return message_of<InvalidInput>([&] { fit_flow(o, region, {.geographic = true, .sides = sides}); });
  };
  EXPECT_EQ(message(10, 0, 95),
            "fit_flow: expected latitudes (y) of the region between -90 and 90 degrees, poles excluded, found 0 to 95");
  EXPECT_THAT(message(10, -90, 0), HasSubstr("poles excluded, found -90 to 0"));
  EXPECT_THAT(message(361, 0, 10), HasSubstr("over at most 360 degrees, found 0 to 361"));
  EXPECT_THAT(message(10, 0, 10, {FlowSide::Free, FlowSide::Free, FlowSide::Periodic, FlowSide::Periodic}),
              HasSubstr("periodic sides in longitude alone"));
  EXPECT_THAT(message_of<InvalidInput>([] { FlowGeometry::sphere(0); }), HasSubstr("positive radius, found 0"));
  EXPECT_THAT(message_of<InvalidInput>([] {
                const FlowField field = random_field(europe, true, false);
                inner_product(field, field);
              }),
              HasSubstr("in a plane"));
}

}  // namespace
}  // namespace batten
