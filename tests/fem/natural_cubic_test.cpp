// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/curve_fit.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<double> whole_knots(int cells) {
  std::vector<double> knots(static_cast<std::size_t>(cells) + 1);
  std::iota(knots.begin(), knots.end(), 0);
  return knots;
}

std::vector<double> random_knots(int cells, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> width(0.1, 2);
  std::vector<double> knots = {-1};
  for (int i = 0; i < cells; ++i) knots.push_back(knots.back() + width(random));
  return knots;
}

Eigen::MatrixXd random_points(int n, int dimension, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> value;
  Eigen::MatrixXd points(n, dimension);
  for (Eigen::Index k = 0; k < points.size(); ++k) points.data()[k] = value(random);
  return points;
}

double largest(const Eigen::MatrixXd& m) { return m.cwiseAbs().maxCoeff(); }

NaturalCubic identity_curve(int cells) { return {whole_knots(cells), Eigen::MatrixXd::Identity(cells + 1, cells + 1)}; }

// Of the identity as coefficients, values are N, forces E and refined coefficients S.

TEST(NaturalCubic, has_the_printed_energy_matrix) {  // [Warren & Weimer 2001, sec. 6.2.2], variational.md 6.2
  Eigen::MatrixXd e(5, 5);
  e << 1, -2, 1, 0, 0, -2, 5, -4, 1, 0, 1, -4, 6, -4, 1, 0, 1, -4, 5, -2, 0, 0, 1, -2, 1;
  EXPECT_LT(largest(identity_curve(4).forces() - e), 1e-14);
}

TEST(NaturalCubic, has_the_printed_subdivision_rules) {  // [ibid., sec. 6.2.4]
  Eigen::MatrixXd s(9, 5);
  s << 8, 0, 0, 0, 0, 4, 4, 0, 0, 0, 1, 6, 1, 0, 0, 0, 4, 4, 0, 0, 0, 1, 6, 1, 0, 0, 0, 4, 4, 0, 0, 0, 1, 6, 1, 0, 0, 0,
      4, 4, 0, 0, 0, 0, 8;
  EXPECT_LT(largest(8 * identity_curve(4).refined().coefficients() - s), 1e-14);
}

TEST(NaturalCubic, has_the_printed_interpolation_matrix) {  // [ibid., sec. 6.3.1]
  Eigen::MatrixXd n(5, 5);
  n << 6, 0, 0, 0, 0, 1, 4, 1, 0, 0, 0, 1, 4, 1, 0, 0, 0, 1, 4, 1, 0, 0, 0, 0, 6;
  EXPECT_LT(largest(6 * identity_curve(4).values() - n), 1e-14);
}

TEST(NaturalCubic, has_the_printed_bezier_points) {  // [ibid., sec. 6.2.4]: the first and the third basis function
  const Eigen::MatrixXd b = identity_curve(4).bezier();
  Eigen::VectorXd first(13), third(13);
  first << 6, 4, 2, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0;
  third << 0, 0, 0, 1, 2, 4, 4, 4, 2, 1, 0, 0, 0;
  EXPECT_LT(largest(6 * b.col(0) - first), 1e-14);
  EXPECT_LT(largest(6 * b.col(2) - third), 1e-14);
  EXPECT_LT(largest(b.rowwise().sum() - Eigen::VectorXd::Ones(13)), 1e-14);
}

TEST(NaturalCubic, refinement_keeps_the_curve_and_its_forces) {
  for (bool closed : {false, true}) {
    const auto knots = random_knots(7, 1);
    const NaturalCubic curve(knots, random_points(closed ? 7 : 8, 2, 2), closed);
    const NaturalCubic fine = curve.refined();
    for (double t = -1.5; t < knots.back() + 0.5; t += 0.1)
      for (int order : {0, 1, 2, 3})
        EXPECT_LT(largest(curve.derivative(t, order) - fine.derivative(t, order)), 1e-11) << t << ' ' << order;
    const Eigen::MatrixXd before = curve.forces(), after = fine.forces();  // E S = U E
    for (Eigen::Index i = 0; i < after.rows(); ++i) {
      Eigen::RowVectorXd difference = after.row(i);
      if (i % 2 == 0) difference -= before.row(i / 2);
      EXPECT_LT(largest(difference), 1e-10 * largest(before));
    }
    EXPECT_NEAR(fine.energy(), curve.energy(), 1e-12 * curve.energy());
    for (Eigen::Index i = 0; i < before.rows(); ++i)
      EXPECT_LT(largest(fine.values().row(2 * i) - curve.values().row(i)), 1e-13);
  }
}

TEST(NaturalCubic, derivatives_are_differences) {
  const auto knots = random_knots(6, 3);
  const NaturalCubic curve(knots, random_points(7, 3, 4));
  const double h = 1e-5;
  for (double t : {knots[0] - 1, knots[0] + 0.05, knots[2] + 0.01, knots[3], knots[6] - 0.01, knots[6] + 2})
    for (int order : {1, 2})
      EXPECT_LT(largest(curve.derivative(t, order) -
                        (curve.derivative(t + h, order - 1) - curve.derivative(t - h, order - 1)) / (2 * h)),
                1e-3);
  EXPECT_LT(largest(curve.derivative(knots[0], 2)), 1e-12);
  EXPECT_LT(largest(curve.derivative(knots[6] - 1e-12, 2)), 1e-9);
}

TEST(NaturalCubic, energy_is_forces_times_values) {  // p_0^T E_0 N_0 p_0 [ibid., th. 6.4]
  for (bool closed : {false, true}) {
    const NaturalCubic curve(random_knots(9, 5), random_points(closed ? 9 : 10, 2, 6), closed);
    EXPECT_NEAR(curve.forces().cwiseProduct(curve.values()).sum(), curve.energy(), 1e-11 * curve.energy());
  }
}

TEST(InterpolatingCurve, passes_through_its_points_with_the_least_energy) {
  for (bool closed : {false, true})
    for (int cells : {3, 4, 9, 10, 60}) {
      const auto knots = random_knots(cells, 7);
      const Eigen::MatrixXd points = random_points(closed ? cells : cells + 1, 2, 8);
      const NaturalCubic curve = interpolating_curve(knots, points, closed);
      EXPECT_LT(largest(curve.values() - points), 1e-12) << cells;
      const NaturalCubic fine = curve.refined();
      Eigen::MatrixXd other = fine.values() + 1e-3 * random_points(static_cast<int>(fine.coefficients().rows()), 2, 9);
      for (Eigen::Index i = 0; i < other.rows(); i += 2) other.row(i) = points.row(i / 2);
      EXPECT_GT(interpolating_curve(fine.knots(), other, closed).energy(), curve.energy());
    }
}

TEST(InterpolatingCurve, reproduces_straight_lines_and_circles) {
  const auto knots = random_knots(20, 11);
  Eigen::MatrixXd line(21, 1);
  for (int i = 0; i <= 20; ++i) line(i, 0) = 3 - 2 * knots[static_cast<std::size_t>(i)];
  EXPECT_LT(interpolating_curve(knots, line).energy(), 1e-24);
  double before = 1;
  for (int n : {20, 40, 80}) {  // order 4
    Eigen::MatrixXd circle(n, 2);
    std::vector<double> angles;
    for (int i = 0; i <= n; ++i) angles.push_back(2 * std::numbers::pi * i / n);
    for (int i = 0; i < n; ++i)
      circle.row(i) << std::cos(angles[static_cast<std::size_t>(i)]), std::sin(angles[static_cast<std::size_t>(i)]);
    const NaturalCubic curve = interpolating_curve(angles, circle, true);
    const double error = std::abs(curve.derivative(angles[1] / 2).norm() - 1);
    EXPECT_LT(error, before / 15);
    before = error;
  }
}

TEST(InterpolatingCurve, of_two_points_is_their_line) {
  const NaturalCubic curve = interpolating_curve({0, 2}, (Eigen::MatrixXd(2, 1) << 1, 5).finished());
  EXPECT_DOUBLE_EQ(curve.derivative(0.5)[0], 2);
  EXPECT_DOUBLE_EQ(interpolating_curve({0, 2, 3}, (Eigen::MatrixXd(3, 1) << 1, 5, 7).finished()).derivative(1)[0], 3);
}

TEST(SmoothingCurve, solves_the_normal_equations) {
  for (bool closed : {false, true})
    for (int cells : {3, 5, 12, 40})
      for (double lambda : {1e-6, 0.1, 1e3}) {
        const auto knots = random_knots(cells, 12);
        const int n = closed ? cells : cells + 1;
        const Eigen::MatrixXd points = random_points(n, 2, 13);
        std::vector<double> weights;
        for (int i = 0; i < n; ++i) weights.push_back(0.5 + i % 3);
        const NaturalCubic curve = smoothing_curve(knots, points, weights, lambda, closed);
        // w (p - b) + λ E p = 0
        Eigen::MatrixXd gradient = lambda * curve.forces();
        const Eigen::MatrixXd misfit = curve.values() - points;
        for (int i = 0; i < n; ++i) gradient.row(i) += weights[static_cast<std::size_t>(i)] * misfit.row(i);
        EXPECT_LT(largest(gradient), 1e-9 * (1 + lambda)) << cells << ' ' << lambda;
      }
}

TEST(SmoothingCurve, damps_a_sine_exactly_whatever_the_length_over_which_it_smooths) {
  // On equal cells of width h the periodic smoothing spline of exp(i k t) is its multiple by 1 / (1 + λ E(k h) / h³):
  // E is the symbol of forces for values on whole knots, (2 - 2 cos)² over the Fourier sum (4 + 2 cos) / 6.
  for (int n : {1000, 20000, 1000000}) {
    const double period = 2 * std::numbers::pi, h = period / n;
    std::vector<double> knots(static_cast<std::size_t>(n) + 1);
    for (int i = 0; i <= n; ++i) knots[static_cast<std::size_t>(i)] = period * i / n;
    for (double length : {1., 10., 300., n / 300., n / 30., n / 3.}) {
      const double lambda = std::pow(length, 4) * std::pow(h, 3);
      for (int k : {1, 3, n / 7}) {
        Eigen::MatrixXd points(n, 1);
        for (int i = 0; i < n; ++i) points(i, 0) = std::sin(period * static_cast<double>(std::int64_t{k} * i % n) / n);
        const double sine = std::sin(k * h / 2), energy = 16 * std::pow(sine, 4) / (1 - 2 * sine * sine / 3);
        const Eigen::MatrixXd expected = points / (1 + std::pow(length, 4) * energy);
        const double error = largest(smoothing_curve(knots, points, {}, lambda, true).values() - expected);
        EXPECT_LT(error, 1e-10) << n << ' ' << length << ' ' << k;
        if (k * length < n) {
          EXPECT_LT(error, 1e-9 * largest(expected)) << n << ' ' << length << ' ' << k;
        }
      }
    }
  }
}

TEST(SmoothingCurve, is_the_regression_line_in_the_limit) {
  for (int n : {2, 3, 50, 100000, 1000000}) {
    const auto whole = random_knots(n - 1, 21);
    std::vector<double> knots, weights;
    Eigen::MatrixXd points = random_points(n, 2, 22);
    long double w = 0, wt = 0, wtt = 0, wb = 0, wtb = 0;
    for (int i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      knots.push_back(1e6 + whole[k]);
      weights.push_back(1 + i % 3);
      points(i, 1) += 1e6 + 0.25 * whole[k];
    }
    for (int i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const long double t = knots[k] - knots[0], weight = weights[k], b = points(i, 1) - 1e6;
      w += weight, wt += weight * t, wtt += weight * t * t, wb += weight * b, wtb += weight * t * b;
    }
    const long double slope = (w * wtb - wt * wb) / (w * wtt - wt * wt), start = (wb - slope * wt) / w;
    for (double lambda : {1e40, 1e300}) {
      const Eigen::MatrixXd p = smoothing_curve(knots, points, weights, lambda).coefficients();
      double error = 0;  // coefficients of a line lie on it, at the means of three knots; its ends are values
      for (int i : {0, n - 1}) {
        const long double t = knots[static_cast<std::size_t>(i)] - knots[0];
        error = std::max(error, std::abs(static_cast<double>(p(i, 1) - (1e6 + start + slope * t))));
      }
      EXPECT_LT(error, 1e-9 * (largest(points) - 1e6 + 1)) << n << ' ' << lambda;
    }
    EXPECT_LT(largest(smoothing_curve(knots, points, weights, 1e300).coefficients().col(0)), 1 + 4.) << n;
  }
}

TEST(SmoothingCurve, interpolates_in_the_other_limit_and_is_constant_in_the_closed_one) {
  const auto knots = random_knots(3000, 23);
  const Eigen::MatrixXd points = random_points(3000, 2, 24);
  const Eigen::MatrixXd through = interpolating_curve(knots, points, true).coefficients();
  for (double lambda : {1e-16, 1e-60, 1e-300})
    EXPECT_LT(largest(smoothing_curve(knots, points, {}, lambda, true).coefficients() - through), 1e-10) << lambda;
  for (double lambda : {1e30, 1e60, 1e300}) {
    const Eigen::MatrixXd p = smoothing_curve(knots, points, {}, lambda, true).coefficients();
    EXPECT_LT(largest(p.rowwise() - points.colwise().mean()), 1e-9) << lambda;
  }
}

TEST(Curves, of_many_blocks_are_solutions_too) {
  for (bool closed : {false, true})
    for (int cells : {63, 127, 128, 129, 1000, 9001}) {
      const auto knots = random_knots(cells, 25);
      const int n = closed ? cells : cells + 1;
      const Eigen::MatrixXd points = random_points(n, 2, 26);
      const NaturalCubic through = interpolating_curve(knots, points, closed);
      EXPECT_LT(largest(through.values() - points), 1e-12) << cells;
      for (double lambda : {1e-6, 1., 1e4}) {
        const NaturalCubic near = smoothing_curve(knots, points, {}, lambda, closed);
        const Eigen::MatrixXd gradient = near.values() - points + lambda * near.forces();  // p - b + λ E p = 0
        EXPECT_LT(largest(gradient), 1e-9 * (1 + lambda)) << cells << ' ' << lambda;
      }
    }
}

TEST(Curves, have_the_same_bits_for_every_number_of_threads) {
  const auto knots = random_knots(30000, 27);
  const Eigen::MatrixXd points = random_points(30000, 2, 28);
  const int threads = omp_get_max_threads();
  std::vector<Eigen::MatrixXd> results;
  for (int count : {1, 2, 3}) {
    omp_set_num_threads(count);
    results.push_back(interpolating_curve(knots, points, true).coefficients());
    results.push_back(smoothing_curve(knots, points, {}, 1e5, true).coefficients());
  }
  omp_set_num_threads(threads);
  for (std::size_t k = 2; k < results.size(); ++k) EXPECT_TRUE(results[k] == results[k % 2]) << k;
}

TEST(SmoothingCurve, moves_from_the_points_to_their_regression_line) {
  const auto knots = whole_knots(30);
  const Eigen::MatrixXd points = random_points(31, 1, 14);
  EXPECT_LT(largest(smoothing_curve(knots, points, {}, 0).values() - points), 1e-13);
  const NaturalCubic line = smoothing_curve(knots, points, {}, 1e9);
  EXPECT_LT(line.energy(), 1e-12);
  EXPECT_NEAR((line.values() - points).sum(), 0, 1e-8);
}

TEST(CurveWithin, keeps_every_point_and_needs_less_energy) {
  for (bool closed : {false, true}) {
    const auto knots = random_knots(40, 15);
    const int n = closed ? 40 : 41;
    const Eigen::MatrixXd points = random_points(n, 2, 16);
    std::vector<double> tolerances;
    for (int i = 0; i < n; ++i) tolerances.push_back(i % 2 ? 0.5 : 0.1);
    const NaturalCubic curve = curve_within(knots, points, tolerances, closed);
    const Eigen::VectorXd misfit = (curve.values() - points).rowwise().norm();
    for (int i = 0; i < n; ++i) EXPECT_LE(misfit[i], tolerances[static_cast<std::size_t>(i)]);
    EXPECT_LT(curve.energy(), 0.9 * interpolating_curve(knots, points, closed).energy());
    // where there is room no force acts; where one acts the point is at its tolerance and the force pulls it there
    const Eigen::MatrixXd forces = curve.forces();
    const double scale = largest(forces);
    for (int i = 0; i < n; ++i) {
      const double force = forces.row(i).norm();
      if (misfit[i] < 0.98 * tolerances[static_cast<std::size_t>(i)]) {
        EXPECT_LT(force, 0.02 * scale) << i;
      }
      if (force <= 0.02 * scale) continue;
      EXPECT_LT(forces.row(i).dot((curve.values() - points).row(i)), -0.9 * force * misfit[i]) << i;
    }
  }
  EXPECT_LT(curve_within(whole_knots(9), random_points(10, 1, 17), std::vector<double>(10, 100.)).energy(), 1e-6);
}

TEST(CurveParameters, are_sums_of_powers_of_distances) {
  const Eigen::MatrixXd points = (Eigen::MatrixXd(3, 2) << 0, 0, 3, 4, 3, 0).finished();
  EXPECT_THAT(curve_parameters(points, 0), testing::ElementsAre(0, 1, 2));
  EXPECT_THAT(curve_parameters(points, 1, true), testing::ElementsAre(0, 5, 9, 12));
  EXPECT_THAT(curve_parameters(points, 0.5), testing::ElementsAre(0, std::sqrt(5.), std::sqrt(5.) + 2));
}

TEST(Curves, refuse_what_cannot_be) {
  const Eigen::MatrixXd points = random_points(4, 2, 18);
  EXPECT_THAT(
      [&] {
        interpolating_curve({0, 1, 1, 2}, points);
      },
      ThrowsMessage<InvalidInput>(HasSubstr("knots must increase, found 1.000000 and 1.000000 at places 1 and 2")));
  EXPECT_THAT(
      [&] {
        interpolating_curve({0, 1, 2}, points);
      },
      ThrowsMessage<InvalidInput>(HasSubstr("3 knots have 3 coefficients, found 4")));
  EXPECT_THAT(
      [&] {
        interpolating_curve({0, 1, 2}, points.topRows(2), true);
      },
      ThrowsMessage<InvalidInput>(HasSubstr("at least 4 knots are needed for a closed curve")));
  EXPECT_THAT([&] { interpolating_curve({0}, points.topRows(1)); },
              ThrowsMessage<InvalidInput>(HasSubstr("at least 2 knots")));
  const std::vector<double> weights = {1, 1, 0, 1};
  EXPECT_THAT(
      [&] {
        smoothing_curve({0, 1, 2, 3}, points, weights, 1);
      },
      ThrowsMessage<InvalidInput>(HasSubstr("weights must be positive, found 0.000000 at place 2")));
  EXPECT_THAT(
      [&] {
        smoothing_curve({0, 1, 2, 3}, points, {}, -1);
      },
      ThrowsMessage<InvalidInput>(HasSubstr("not negative, found -1")));
  EXPECT_THAT(
      [&] {
        curve_within({0, 1, 2, 3}, points, weights);
      },
      ThrowsMessage<InvalidInput>(HasSubstr("tolerances must be positive, found 0.000000 at place 2")));
  EXPECT_THAT([&] { curve_parameters((Eigen::MatrixXd(3, 1) << 1, 2, 2).finished(), 1); },
              ThrowsMessage<InvalidInput>(HasSubstr("found points 1 and 2 at the same place")));
}

}  // namespace
}  // namespace batten
