// SPDX-License-Identifier: MIT
#include <batten/fem/plate_forces.h>

#include "../support/laws.h"
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace batten {
namespace {

const Rectangle region{Interval(-1, 2, 6), Interval(0.5, 2, 5)};

/// The spline that is w: its coefficients by collocation at as many places as there are functions in each direction.
Solution spline_of(const std::function<double(double, double)>& w, int degree, const Rectangle& r = region) {
  const SplineBasis x(r.x, degree), y(r.y, degree);
  const auto places = [&](const SplineBasis& basis) {  // the Greville abscissae of the clamped knots, in cells
    Eigen::VectorXd g(basis.size());
    for (int i = 0; i < basis.size(); ++i) {
      double sum = 0;
      for (int k = 1; k <= degree; ++k) sum += std::clamp(i + k - degree, 0, basis.interval().cells());
      g[i] = sum / degree;
    }
    return g;
  };
  const auto collocation = [&](const SplineBasis& basis, const Eigen::VectorXd& t) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(basis.size(), basis.size());
    for (int i = 0; i < basis.size(); ++i) {
      const auto local = basis.at(t[i]);
      for (int a = 0; a <= degree; ++a) A(i, local.first + a) = local.values[static_cast<std::size_t>(a)];
    }
    return A;
  };
  const Eigen::VectorXd tx = places(x), ty = places(y);
  Eigen::MatrixXd values(x.size(), y.size());
  for (int j = 0; j < y.size(); ++j)
    for (int i = 0; i < x.size(); ++i)
      values(i, j) =
          w(r.x.lower() + tx[i] * r.x.length() / r.x.cells(), r.y.lower() + ty[j] * r.y.length() / r.y.cells());
  const Eigen::MatrixXd half = collocation(x, tx).fullPivLu().solve(values);
  const Eigen::MatrixXd c = collocation(y, ty).fullPivLu().solve(half.transpose()).transpose();
  return {r, degree, {c.data(), c.data() + c.size()}};
}

double mean(const std::function<double(double)>& f, const Interval& range) {
  // Gauss-Legendre on 3 points a cell: exact to degree 5.
  double sum = 0;
  const double h = range.length() / range.cells(), g = std::sqrt(0.6);
  for (int i = 0; i < range.cells(); ++i) {
    const double middle = (range.coordinate(i) + range.coordinate(i + 1)) / 2;
    sum += h / 18 * (5 * f(middle - g * h / 2) + 8 * f(middle) + 5 * f(middle + g * h / 2));
  }
  return sum;
}

TEST(PlateForces, of_a_cubic_are_its_derivatives) {
  // w = x³ + 2 x² y - x y³ + y²: w_xx = 6x + 4y, w_yy = -6xy + 2, w_xy = 4x - 3y², w_xxx = 6, w_xxy = 4, w_xyy = -6y,
  // w_yyy = -6x
  const auto w = [](double x, double y) { return x * x * x + 2 * x * x * y - x * y * y * y + y * y; };
  const KirchhoffPlate plate{.rigidity = 7, .poisson_ratio = 0.25};
  for (const int degree : {3, 4, 5}) {
    const Solution s = spline_of(w, degree);
    for (const double x : {-1., -0.5, 0.1, 2.})
      for (const double y : {0.5, 0.8, 1.7, 2.}) {
        const PlateForces f = plate_forces(s, plate, x, y);
        const double xx = 6 * x + 4 * y, yy = -6 * x * y + 2, xy = 4 * x - 3 * y * y, near = 1e-9;
        EXPECT_NEAR(f.Mx, -7 * (xx + 0.25 * yy), near);
        EXPECT_NEAR(f.My, -7 * (yy + 0.25 * xx), near);
        EXPECT_NEAR(f.Mxy, -7 * 0.75 * xy, near);
        EXPECT_NEAR(f.Qx, -7 * (6 - 6 * y), near);
        EXPECT_NEAR(f.Qy, -7 * (4 - 6 * x), near);
      }
  }
}

TEST(PlateForces, of_a_variable_rigidity_follow_the_product_rule) {
  // w = x² + x y, D = 1 + x + y²: Mx = -2 D, My = -2 nu D, Mxy = -(1 - nu) D
  const double nu = 0.3;
  const KirchhoffPlate plate{Field([](double x, double y) { return 1 + x + y * y; }), nu};
  const Solution s = spline_of([](double x, double y) { return x * x + x * y; }, 3);
  for (const double x : {-0.9, 0.3, 1.})
    for (const double y : {0.7, 1.4}) {
      const PlateForces f = plate_forces(s, plate, x, y);
      EXPECT_NEAR(f.Mx, -2 * (1 + x + y * y), 1e-10);
      EXPECT_NEAR(f.Qx, -2 - (1 - nu) * 2 * y, 1e-8);
      EXPECT_NEAR(f.Qy, -(1 - nu) - 2 * nu * 2 * y, 1e-8);
    }
}

TEST(PlateForces, hold_the_balance_of_the_whole_plate) {
  // ∮ V_n + Σ corners + ∫∫ (D Δ²w - T Δw) = 0 for any w, here with Δ²w = 8 + 24 x y, Δw = 2x³y + 6xy³... by quadrature
  const auto w = [](double x, double y) { return x * x * y * y + x * x * x * y * y * y / 3 + x * y + 2 * x - y * y; };
  const auto bilaplacian = [](double x, double y) { return 8 + 24 * x * y; };
  const auto laplacian = [](double x, double y) {
    return 2 * y * y + 2 * x * y * y * y + 2 * x * x + 2 * x * x * x * y - 2;
  };
  const KirchhoffPlate plate{.rigidity = 3, .poisson_ratio = 0.2, .tension = 5};
  for (const int degree : {3, 5}) {
    const Solution s = spline_of(w, degree);
    double sum = mean(
        [&](double x) { return mean([&](double y) { return 3 * bilaplacian(x, y) - 5 * laplacian(x, y); }, region.y); },
        region.x);
    for (const Edge edge : {Edge::Left, Edge::Right, Edge::Bottom, Edge::Top}) {
      const bool along_y = edge == Edge::Left || edge == Edge::Right;
      sum += mean([&](double v) { return edge_reaction(s, plate, edge, v); }, along_y ? region.y : region.x);
    }
    for (const double corner : corner_forces(s, plate)) sum += corner;
    EXPECT_NEAR(sum, 0, 1e-7);
  }
}

TEST(PlateForces, of_a_supported_plate_under_load_have_the_signs_of_the_manual) {
  // Close to the deflection of the simply supported square under a load in its direction.
  const Rectangle square{Interval(0, 1, 16), Interval(0, 1, 16)};
  const Solution s =
      spline_of([](double x, double y) { return std::sin(3.14159265 * x) * std::sin(3.14159265 * y); }, 3, square);
  const KirchhoffPlate plate;
  EXPECT_GT(plate_forces(s, plate, 0.5, 0.5).Mx, 0);
  EXPECT_GT(plate_forces(s, plate, 0.5, 0.5).My, 0);
  for (const Edge edge : {Edge::Left, Edge::Right, Edge::Bottom, Edge::Top})
    EXPECT_LT(edge_reaction(s, plate, edge, 0.5), 0);
  for (const double corner : corner_forces(s, plate)) EXPECT_GT(corner, 0);
}

TEST(PlateForces, samples_are_the_forces_at_the_corners_of_the_cells) {
  const KirchhoffPlate plate{Field([](double x, double y) { return 2 + x * y; }), 0.3, 0, 0.5};
  for (const int degree : {2, 3, 4, 5}) {
    const auto size = static_cast<std::size_t>((6 + degree) * (5 + degree));
    const Solution s(region, degree, test::random_vector(size, 3));
    const auto arrays = force_samples(s, plate);
    ASSERT_EQ(arrays.size(), 6U);
    for (int j = 0; j <= 5; ++j)
      for (int i = 0; i <= 6; ++i) {
        const PlateForces f = plate_forces(s, plate, region.x.coordinate(i), region.y.coordinate(j));
        const auto k = static_cast<std::size_t>(j * 7 + i);
        const std::array expected = {f.Mx, f.My, f.Mxy, f.Qx, f.Qy};
        for (std::size_t a = 0; a < 5; ++a)
          EXPECT_NEAR(arrays[a].values[k], expected[a], 1e-8 * (1 + std::abs(expected[a]))) << arrays[a].name;
        EXPECT_EQ(std::isnan(arrays[5].values[k]), (i == 0 || i == 6) == (j == 0 || j == 5));
      }
    const double reaction = edge_reaction(s, plate, Edge::Left, region.y.coordinate(2));
    EXPECT_NEAR(arrays[5].values[2 * 7], reaction, 1e-8 * (1 + std::abs(reaction)));
    const double top = edge_reaction(s, plate, Edge::Top, region.x.coordinate(4));
    EXPECT_NEAR(arrays[5].values[5 * 7 + 4], top, 1e-8 * (1 + std::abs(top)));
  }
}

TEST(PlateForces, of_symmetric_plates_are_symmetric_where_derivatives_jump) {
  // w = |x|³ + y² about x = 0 in quadratic splines would bend one-sidedly if only one limit counted.
  const Rectangle r{Interval(-1, 1, 4), Interval(-1, 1, 4)};
  const Solution s = spline_of([](double x, double y) { return std::abs(x * x * x) + y * y; }, 2, r);
  for (const double x : {0.5, 1.}) EXPECT_NEAR(plate_forces(s, {}, x, 0.5).Mx, plate_forces(s, {}, -x, 0.5).Mx, 1e-12);
}

TEST(PlateForces, are_nan_outside) {
  const Solution s = spline_of([](double x, double) { return x; }, 3);
  EXPECT_TRUE(std::isnan(plate_forces(s, {}, 3, 1).Mx));
  EXPECT_TRUE(std::isnan(edge_reaction(s, {}, Edge::Left, 3)));
}

}  // namespace
}  // namespace batten
