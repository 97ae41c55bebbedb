// SPDX-License-Identifier: MIT
// What blocks of curves must not change: accuracy where neighbouring cells differ by 10^6, and refusals.
#include <batten/domains/errors.h>
#include <batten/fem/curve_fit.h>

#include <Eigen/SparseCholesky>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace batten {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

using Long = long double;
using LongVector = Eigen::Matrix<Long, Eigen::Dynamic, 1>;
using LongSparse = Eigen::SparseMatrix<Long>;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Widths from 10^-6 to 1, neighbours in any ratio; or these two in turn.
std::vector<double> wild_knots(int cells, bool alternate) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> exponent(-6, 0);
  std::vector<double> knots = {0};
  for (int i = 0; i < cells; ++i)
    knots.push_back(knots.back() + (alternate ? (i % 2 == 0 ? 1e-6 : 1) : std::pow(10, exponent(random))));
  return knots;
}

Eigen::MatrixXd random_points(int n, int dimension) {
  std::mt19937 random(32);
  std::normal_distribution<double> value;
  Eigen::MatrixXd points(n, dimension);
  for (Eigen::Index k = 0; k < points.size(); ++k) points.data()[k] = value(random);
  return points;
}

std::vector<double> whole_knots(int cells) {
  std::vector<double> knots(static_cast<std::size_t>(cells) + 1);
  std::iota(knots.begin(), knots.end(), 0);
  return knots;
}

LongVector widths_of(const std::vector<double>& knots) {
  LongVector h(static_cast<Eigen::Index>(knots.size()) - 1);
  for (Eigen::Index i = 0; i < h.size(); ++i)
    h[i] = static_cast<Long>(knots[static_cast<std::size_t>(i) + 1]) - knots[static_cast<std::size_t>(i)];
  return h;
}

/// Of the open smoothing spline, λ = 0 interpolates, from its second derivatives γ at inner knots:
/// (R + λ Q^T Q) γ = Q^T b, values b - λ Q γ [Reinsch 1967], as sparse matrices in extended precision.
LongVector reference_coefficients(const std::vector<double>& knots, const LongVector& b, Long lambda) {
  const LongVector h = widths_of(knots);
  const int n = static_cast<int>(b.size()), inner = n - 2;
  std::vector<Eigen::Triplet<Long>> q, r;
  for (int j = 0; j < inner; ++j) {
    q.insert(q.end(), {{j, j, 1 / h[j]}, {j + 1, j, -1 / h[j] - 1 / h[j + 1]}, {j + 2, j, 1 / h[j + 1]}});
    r.emplace_back(j, j, (h[j] + h[j + 1]) / 3);
    if (j + 1 < inner) r.insert(r.end(), {{j, j + 1, h[j + 1] / 6}, {j + 1, j, h[j + 1] / 6}});
  }
  LongSparse big_q(n, inner), big_r(inner, inner);
  big_q.setFromTriplets(q.begin(), q.end());
  big_r.setFromTriplets(r.begin(), r.end());
  const LongSparse system = big_r + LongSparse(lambda * (big_q.transpose() * big_q));
  LongVector g = LongVector::Zero(n);
  g.segment(1, inner) = Eigen::SimplicialLDLT<LongSparse>(system).solve(big_q.transpose() * b);
  const LongVector f = b - lambda * (big_q * g.segment(1, inner));
  LongVector p = f;
  for (int i = 1; i + 1 < n; ++i) {
    const Long slope = (f[i + 1] - f[i]) / h[i] - h[i] * (2 * g[i] + g[i + 1]) / 6;
    p[i] = f[i] + slope * (h[i] - h[i - 1]) / 3 - g[i] * h[i - 1] * h[i] / 6;
  }
  return p;
}

/// |coefficient - reference| over the largest reference.
double error_of(const NaturalCubic& curve, const LongVector& reference) {
  const LongVector difference = curve.coefficients().col(0).cast<Long>() - reference;
  return static_cast<double>(difference.cwiseAbs().maxCoeff() / reference.cwiseAbs().maxCoeff());
}

TEST(InterpolatingCurve, is_exact_where_neighbouring_cells_differ_by_a_million) {
  for (bool alternate : {false, true})
    for (int n : {40, 1000, 20000}) {
      const auto knots = wild_knots(n - 1, alternate);
      const Eigen::MatrixXd points = random_points(n, 1);
      const LongVector reference = reference_coefficients(knots, points.col(0).cast<Long>(), 0);
      EXPECT_LT(error_of(interpolating_curve(knots, points), reference), 10 * epsilon) << n << ' ' << alternate;
    }
}

TEST(InterpolatingCurve, does_not_depend_on_the_unit_of_its_knots) {
  const auto knots = wild_knots(300, false);
  const Eigen::MatrixXd points = random_points(301, 1), expected = interpolating_curve(knots, points).coefficients();
  for (int exponent : {-300, 300}) {
    std::vector<double> scaled = knots;
    for (double& knot : scaled) knot = std::ldexp(knot, exponent);
    EXPECT_TRUE(interpolating_curve(scaled, points).coefficients() == expected) << exponent;
  }
}

TEST(InterpolatingCurve, that_is_closed_is_an_open_one_that_goes_round) {
  constexpr int n = 500;
  std::mt19937 random(33);
  std::uniform_int_distribution<int> exponent(-20, 0);
  std::vector<double> widths(n), once = {0}, thrice = {0};
  for (double& width : widths) width = std::ldexp(1., exponent(random));  // all knots are exact
  for (int i = 0; i < 3 * n; ++i) {
    thrice.push_back(thrice.back() + widths[i % n]);
    if (i < n) once.push_back(thrice.back());
  }
  const Eigen::MatrixXd points = random_points(n, 1);
  Eigen::MatrixXd round(3 * n + 1, 1);
  for (int i = 0; i <= 3 * n; ++i) round.row(i) = points.row(i % n);
  const Eigen::MatrixXd open = interpolating_curve(thrice, round).coefficients().middleRows(n, n);
  const Eigen::MatrixXd closed = interpolating_curve(once, points, true).coefficients();
  EXPECT_LT((closed - open).cwiseAbs().maxCoeff(), 10 * epsilon * open.cwiseAbs().maxCoeff());
}

TEST(SmoothingCurve, loses_no_more_digits_than_neighbouring_cells_differ_by) {
  for (bool alternate : {false, true})
    for (int n : {40, 1000, 20000})
      for (double lambda : {1e-12, 1e-6}) {
        const auto knots = wild_knots(n - 1, alternate);
        const Eigen::MatrixXd points = random_points(n, 1);
        const LongVector reference = reference_coefficients(knots, points.col(0).cast<Long>(), lambda);
        const NaturalCubic curve = smoothing_curve(knots, points, {}, lambda);
        EXPECT_LT(error_of(curve, reference), 1e6 * 10 * epsilon) << n << ' ' << alternate << ' ' << lambda;
      }
}

TEST(SmoothingCurve, does_not_depend_on_the_units_of_lengths_and_weights) {
  constexpr int n = 3001;
  const auto knots = wild_knots(n - 1, false);
  const Eigen::MatrixXd points = random_points(n, 1);
  std::vector<double> weights(n);
  for (int i = 0; i < n; ++i) weights[static_cast<std::size_t>(i)] = 1 + std::abs(points(i, 0));
  const Eigen::MatrixXd expected = smoothing_curve(knots, points, weights, 1e-6).coefficients();
  for (int length : {-60, 60})
    for (int weight : {-700, 700}) {
      std::vector<double> far = knots, heavy = weights;
      for (double& knot : far) knot = std::ldexp(knot, length);
      for (double& w : heavy) w = std::ldexp(w, weight);
      const double lambda = std::ldexp(1e-6, 3 * length + weight);
      EXPECT_TRUE(smoothing_curve(far, points, heavy, lambda).coefficients() == expected) << length << ' ' << weight;
    }
}

TEST(SmoothingCurve, with_weights_that_are_all_1_is_that_without) {
  for (bool closed : {false, true})
    for (int n : {40, 513, 9001})  // blocks that are no whole chunks, groups with empty lanes
      for (double lambda : {1e-6, 1., 1e12}) {
        const auto knots = whole_knots(closed ? n : n - 1);
        const std::vector<double> weights(static_cast<std::size_t>(n), 1.);
        const Eigen::MatrixXd points = random_points(n, 3);
        const Eigen::MatrixXd plain = smoothing_curve(knots, points, {}, lambda, closed).coefficients();
        const Eigen::MatrixXd weighted = smoothing_curve(knots, points, weights, lambda, closed).coefficients();
        const double difference = (plain - weighted).cwiseAbs().maxCoeff();
        EXPECT_LT(difference, 100 * epsilon * plain.cwiseAbs().maxCoeff()) << closed << ' ' << n << ' ' << lambda;
      }
}

TEST(Curves, of_any_number_of_components_are_those_of_each) {
  const auto knots = wild_knots(9000, false);
  const Eigen::MatrixXd points = random_points(9001, 5);
  for (double lambda : {0., 1e-3}) {
    const Eigen::MatrixXd all = smoothing_curve(knots, points, {}, lambda).coefficients();
    for (int c = 0; c < 5; ++c) {
      const Eigen::MatrixXd one = smoothing_curve(knots, points.col(c), {}, lambda).coefficients();
      EXPECT_TRUE(all.col(c).isApprox(one, 1e-9)) << c << ' ' << lambda;
    }
  }
}

TEST(Curves, have_the_values_of_their_ends) {  // of an open curve the end coefficients
  const auto knots = whole_knots(9000);
  const Eigen::MatrixXd points = random_points(9001, 3), through = interpolating_curve(knots, points).coefficients();
  EXPECT_TRUE(through.row(0) == points.row(0) && through.row(9000) == points.row(9000));
  const NaturalCubic near = smoothing_curve(knots, points, {}, 1);
  const Eigen::MatrixXd forces = near.forces();  // p - b + λ E p = 0
  for (int i : {0, 9000})
    EXPECT_LT((near.coefficients().row(i) - points.row(i) + forces.row(i)).cwiseAbs().maxCoeff(), 100 * epsilon) << i;
}

void expect_points_are_refused(double bad, int n, double lambda, bool closed) {
  const auto knots = whole_knots(closed ? n : n - 1);
  for (int place : {0, 1, 2, n / 2, n - 3, n - 2, n - 1}) {
    Eigen::MatrixXd points = random_points(n, 2);
    points(place, 1) = bad;
    EXPECT_THAT([&] { smoothing_curve(knots, points, {}, lambda, closed); },
                ThrowsMessage<InvalidInput>(HasSubstr("coefficients must be finite")))
        << n << ' ' << place << ' ' << lambda;
  }
}

TEST(Curves, refuse_a_number_that_is_not_finite_wherever_it_is) {
  for (bool closed : {false, true})
    for (double lambda : {0., 1., 1e12})
      for (int n : {7, 300, 9000})
        for (double bad : {not_a_number, std::numeric_limits<double>::infinity()})
          expect_points_are_refused(bad, n, lambda, closed);
}

void expect_knots_are_refused(int place, int n, double lambda, bool closed) {
  auto knots = whole_knots(closed ? n : n - 1);
  const std::string where = "at places " + std::to_string(place - 1) + " and " + std::to_string(place);
  for (double bad : {place - 1., place - 1.5, not_a_number}) {
    knots[static_cast<std::size_t>(place)] = bad;
    EXPECT_THAT([&] { smoothing_curve(knots, random_points(n, 1), {}, lambda, closed); },
                ThrowsMessage<InvalidInput>(testing::AllOf(HasSubstr("knots must increase"), HasSubstr(where))));
  }
}

TEST(Curves, refuse_knots_that_do_not_increase_wherever_they_are) {
  for (bool closed : {false, true})
    for (double lambda : {0., 1.})
      for (int n : {7, 9000})
        for (int place : {1, 2, n / 2, n - 2, n - 1}) expect_knots_are_refused(place, n, lambda, closed);
}

TEST(Curves, refuse_weights_that_are_not_positive_wherever_they_are) {
  constexpr int n = 40000;
  const Eigen::MatrixXd points = random_points(n, 1);
  for (int place : {0, n / 2, n - 1})
    for (double bad : {0., -1., not_a_number, std::numeric_limits<double>::infinity()}) {
      std::vector<double> weights(n, 2);
      weights[static_cast<std::size_t>(place)] = bad;
      EXPECT_THAT([&] { smoothing_curve(whole_knots(n - 1), points, weights, 1); },
                  ThrowsMessage<InvalidInput>(testing::AllOf(HasSubstr("weights must be positive"),
                                                             HasSubstr("at place " + std::to_string(place)))));
    }
}

TEST(Curves, refuse_results_beyond_doubles) {
  const double most = std::numeric_limits<double>::max();
  for (double lambda : {0., 1e-9}) {
    Eigen::MatrixXd points = random_points(9000, 1);
    points(5000, 0) = most, points(5001, 0) = -most;
    EXPECT_THAT([&] { smoothing_curve(whole_knots(8999), points, {}, lambda); },
                ThrowsMessage<InvalidInput>(HasSubstr("coefficients must be finite")));
  }
}

}  // namespace
}  // namespace batten
