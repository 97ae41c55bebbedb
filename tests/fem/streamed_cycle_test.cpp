// SPDX-License-Identifier: MIT
#include <batten/fem/conjugate_gradients.h>
#include <batten/fem/cubic_refinement.h>

#include "../support/laws.h"
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>

namespace batten {
namespace {

constexpr double pi = std::numbers::pi;

struct Trial {
  Hierarchy hierarchy;
  GridPoints none;
  Multigrid system;

  Trial(const Energy& energy, int nx, int ny, int degree, EndCondition end)
      : hierarchy(energy, {Interval(0, 1, nx), Interval(0, double(ny) / nx, ny)}, degree, {}, {{end, end}, {end, end}}),
        system(hierarchy, none) {
    system.set(0.7, {});
  }

  Trial(int order, int nx, int ny, int degree)
      : Trial(order == 1 ? Energy::membrane() : Energy::thin_plate(), nx, ny, degree,
              order == 1 ? EndCondition::Zero : EndCondition::Clamped) {}

  /// Random numbers, 0 where the ends take the function away.
  std::vector<double> vector(unsigned seed) const {
    auto v = test::random_vector(system.size(), seed);
    const auto& s = hierarchy.finest().space;
    for (int j = 0; j < s.y.size(); ++j)
      for (int i = 0; i < s.x.size(); ++i)
        if (s.x.is_removed(i) || s.y.is_removed(j)) v[static_cast<std::size_t>(j * s.x.size() + i)] = 0;
    return v;
  }
};

/// One V-cycle from c; the error of c.
double improve(const Trial& t, const std::vector<double>& b, std::vector<double>& c) {
  double error = -1;
  t.system.streamed()->iterate(StreamedCycle::Begin::AtStart, b, c, [&](const StreamedCycle::Iterate& found) {
    const bool is_first = error < 0;
    if (is_first) error = found.error;
    return is_first;
  });
  return error;
}

TEST(StreamedCycle, is_symmetric_and_positive_and_measures_itself) {
  for (int degree : {1, 2, 3, 4, 5})
    for (int order : {1, 2}) {
      if (degree < order) continue;
      const Trial t(order, 61, 48, degree);
      ASSERT_TRUE(t.system.streamed());
      const auto x = t.vector(1), y = t.vector(2);
      std::vector<double> bx(x.size()), by(x.size()), c(x.size(), 0.);
      t.system.precondition(x, bx);
      t.system.precondition(y, by);
      const double xx = test::dot(x, bx), yy = test::dot(y, by);
      EXPECT_GT(xx, 0);
      EXPECT_NEAR(test::dot(x, by), test::dot(y, bx), 1e-9 * std::sqrt(xx * yy)) << degree;
      EXPECT_NEAR(improve(t, x, c), std::sqrt(xx), 1e-9 * std::sqrt(xx)) << degree;
      // One V-cycle has made bx of 0; c is that or, smoothed once more, nearer to the solution.
      std::vector<double> left(c.size(), 0.), error(c.size()), ae(c.size());
      solve(t.system, x, left, {.accuracy = 1e-13});
      const auto energy = [&](const std::vector<double>& v) {
        for (std::size_t i = 0; i < v.size(); ++i) error[i] = v[i] - left[i];
        return t.system.apply(error, ae);
      };
      EXPECT_LE(energy(c), energy(bx) * (1 + 1e-9)) << degree;
    }
}

TEST(StreamedCycle, solves_for_every_degree) {
  for (int degree : {1, 2, 3, 4, 5})
    for (int order : {1, 2}) {
      if (degree < order) continue;
      const Trial t(order, 250, 173, degree);
      const auto exact = t.vector(3);
      std::vector<double> b(exact.size()), c(exact.size(), 0.), e(exact.size()), ae(exact.size());
      t.system.apply(exact, b);
      const auto result = solve(t.system, b, c);
      EXPECT_LE(result.iterations, degree < 4 ? 20 : 40) << degree << ' ' << order;
      EXPECT_LE(result.accuracy, 1e-9);
      for (std::size_t i = 0; i < e.size(); ++i) e[i] = c[i] - exact[i];
      EXPECT_LE(std::sqrt(t.system.apply(e, ae)), 3e-9 * std::sqrt(test::dot(exact, b))) << degree << ' ' << order;
    }
}

TEST(StreamedCycle, leaves_a_start_that_is_good_enough) {
  const Trial t(1, 61, 48, 1);
  const auto b = t.vector(4);
  std::vector<double> c(b.size(), 0.);
  solve_by_levels(t.system, b, c);
  const auto before = c;
  t.system.streamed()->iterate(StreamedCycle::Begin::AtStart, b, c, [](const auto&) { return false; });
  EXPECT_EQ(c, before);
  EXPECT_GT(improve(t, b, c), 0);
  EXPECT_NE(c, before);
}

// However many V-cycles follow: what is measured of an iterate is what its V-cycle finds, and c is no worse than it.
TEST(StreamedCycle, leaves_what_it_has_measured_or_less_of_the_error) {
  for (int degree : {1, 3}) {
    const Trial t(1, 61, 48, degree);
    const auto exact = t.vector(4);
    std::vector<double> b(exact.size()), e(exact.size()), ae(exact.size()), be(exact.size());
    t.system.apply(exact, b);
    for (int most : {1, 2, 3, 4}) {
      std::vector<double> c(b.size(), 7.);  // which by levels is not looked at
      int count = 0;
      StreamedCycle::Iterate last;
      t.system.streamed()->iterate(StreamedCycle::Begin::ByLevels, b, c, [&](const StreamedCycle::Iterate& found) {
        last = found;
        return ++count < most;
      });
      EXPECT_EQ(count, most);
      for (std::size_t i = 0; i < e.size(); ++i) e[i] = c[i] - exact[i];
      EXPECT_LE(std::sqrt(t.system.apply(e, ae)), 1.2 * last.error) << degree << ' ' << most;  // B leaves less than 0.3
      EXPECT_NEAR(last.size, std::sqrt(test::dot(exact, b)), last.error) << degree << ' ' << most;
    }
  }
}

// Of degree 1 on an even and on an odd grid: cubic refinement is exact for cubics that vanish on the sides.
TEST(CubicRefinement, reproduces_cubics) {
  for (const auto& [nx, ny] : {std::pair{64, 48}, {61, 35}}) {
    const Trial t(1, nx, ny, 1);
    const auto refinement = cubic_refinement(t.hierarchy, 0);
    ASSERT_TRUE(refinement);
    const auto values = [](const SplineSpace& s) {
      std::vector<double> v;
      const double lx = s.x.interval().finest_cells(), ly = s.y.interval().finest_cells();
      for (const int j : s.y.interval().breakpoints())
        for (const int i : s.x.interval().breakpoints())
          v.push_back(i / lx * (1 - i / lx) * (1 + i / lx) * j / ly * (1 - j / ly) * (2 - j / ly));
      return v;
    };
    const auto exact = values(t.hierarchy[0].space);
    std::vector<double> found(exact.size());
    refinement->apply(values(t.hierarchy[1].space), found);
    for (std::size_t i = 0; i < exact.size(); ++i) ASSERT_NEAR(found[i], exact[i], 1e-14);
  }
}

// The discrete solution is sin πx sin πy at the nodes; that of the same problem with exact loads differs from it by
// about h² π² / 12 of itself.
TEST(StreamedCycle, one_pass_over_the_levels_leaves_less_than_a_tenth_of_the_discretisation_error) {
  constexpr int n = 128;
  const Trial t(1, n, n, 1);
  std::vector<double> mode, b(t.system.size()), c(t.system.size());
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mode.push_back(i % n == 0 || j % n == 0 ? 0 : std::sin(pi * i / n) * std::sin(pi * j / n));
  t.system.apply(mode, b);
  solve_by_levels(t.system, b, c);
  const double discretisation = pi * pi / (12. * n * n);
  for (std::size_t i = 0; i < c.size(); ++i) ASSERT_NEAR(c[i], mode[i], 0.1 * discretisation);
}

/// sin kπx sin lπy
double wave(int k, int l, double x, double y) { return std::sin(k * pi * x) * std::sin(l * pi * y); }

/// L2 error of nodal values on n x n cells of the unit square, by two Gauss points in each cell and direction.
double wave_error(const std::vector<double>& v, int n, int k, int l) {
  double sum = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      for (const double s : {0.5 - std::sqrt(1. / 12), 0.5 + std::sqrt(1. / 12)})
        for (const double t : {0.5 - std::sqrt(1. / 12), 0.5 + std::sqrt(1. / 12)}) {
          const double* u = v.data() + static_cast<std::ptrdiff_t>(j) * (n + 1) + i;
          const double value = (1 - t) * ((1 - s) * u[0] + s * u[1]) + t * ((1 - s) * u[n + 1] + s * u[n + 2]);
          sum += std::pow(value - wave(k, l, (i + s) / n, (j + t) / n), 2);
        }
  return std::sqrt(sum / 4) / n;
}

// ∫ sin kπx φ_i dx = sin kπx_i 2 (1 - cos kπh) / (k² π² h) for the hat function φ_i.
TEST(StreamedCycle, one_pass_over_the_levels_reaches_the_discretisation_error) {
  constexpr int n = 128;
  const Trial t(1, n, n, 1);
  for (const auto& [k, l] : {std::pair{1, 1}, {3, 5}, {2, 7}, {16, 1}}) {
    const auto moment = [](int m) { return 2 * (1 - std::cos(m * pi / n)) * n / (m * m * pi * pi); };
    const double load = 0.7 * (k * k + l * l) * pi * pi * moment(k) * moment(l);
    std::vector<double> b, one(t.system.size()), exact(t.system.size(), 0.);
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        b.push_back(i % n == 0 || j % n == 0 ? 0 : load * wave(k, l, double(i) / n, double(j) / n));
    solve_by_levels(t.system, b, one);
    solve(t.system, b, exact, {.accuracy = 1e-12});
    EXPECT_LE(wave_error(one, n, k, l), 1.05 * wave_error(exact, n, k, l)) << k << ' ' << l;
  }
}

TEST(StreamedCycle, has_the_same_bits_for_every_thread_count) {
  const int threads = omp_get_max_threads();
  for (const auto& [order, degree] : {std::pair{1, 1}, {2, 3}}) {
    const Trial t(order, 1100, 310, degree);
    const auto b = t.vector(5);
    std::vector<std::vector<double>> found;
    for (int count : {1, 2, 3, 7}) {
      omp_set_num_threads(count);
      std::vector<double> c(b.size(), 0.);
      solve(t.system, b, c);
      found.push_back(c);
    }
    for (const auto& c : found) EXPECT_EQ(c, found.front()) << degree;
  }
  omp_set_num_threads(threads);
}

}  // namespace
}  // namespace batten
