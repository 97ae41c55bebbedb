// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_solver.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

// Boundary value problems on the unit square whose solution is known.
namespace batten::test {

inline Rectangle unit_square(int cells) { return {Interval(0, 1, cells), Interval(0, 1, cells)}; }

/// u and its derivatives up to order 4 as a product of functions of one variable.
struct Product {
  std::function<double(double, int)> x, y;
  double operator()(double s, double t, int a, int b) const { return x(s, a) * y(t, b); }
  double laplacian(double s, double t) const { return (*this)(s, t, 2, 0) + (*this)(s, t, 0, 2); }
  double bilaplacian(double s, double t) const {
    return (*this)(s, t, 4, 0) + 2 * (*this)(s, t, 2, 2) + (*this)(s, t, 0, 4);
  }
};

/// amplitude cos(frequency t + phase)
inline std::function<double(double, int)> wave(double amplitude, double frequency, double phase) {
  return [=](double t, int order) {
    return amplitude * std::pow(frequency, order) * std::cos(frequency * t + phase + order * std::numbers::pi / 2);
  };
}

/// sin(π t)^4: value and three derivatives vanish at 0 and 1, so that it meets every homogeneous condition there.
inline double flat(double t, int order) {
  const double constant = order == 0 ? 3. / 8 : 0;
  return constant + wave(-0.5, 2 * std::numbers::pi, 0)(t, order) + wave(0.125, 4 * std::numbers::pi, 0)(t, order);
}

/// Root mean square of the error of the derivatives of one order.
inline double error_of(const Solution& solution, const Product& exact, int order) {
  constexpr int samples = 97;
  double sum = 0;
  for (int j = 0; j < samples; ++j)
    for (int i = 0; i < samples; ++i)
      for (int a = 0; a <= order; ++a) {
        const double x = (i + 0.5) / samples, y = (j + 0.5) / samples;
        sum += std::pow(solution.derivative(x, y, a, order - a) - exact(x, y, a, order - a), 2);
      }
  return std::sqrt(sum) / samples;
}

/// Observed orders in L2, H1 (and H2) between two grids against min(d + 1, 2 (d + 1 - m)), d, d - 1.
inline void expect_orders(BoundaryProblem problem, const Product& exact, int cells) {
  const int d = problem.degree, m = problem.is_plate() ? 2 : 1;
  const auto solve = [&](int n) {
    problem.region = unit_square(n);
    return solve_boundary_problem(problem, {.limits = {.accuracy = 1e-12}}).solution;
  };
  const Solution coarse = solve(cells), fine = solve(2 * cells);
  for (int order = 0; order <= m && order < d + 1; ++order) {
    const double expected = std::min(d + 1 - order, 2 * (d + 1 - m));
    const double before = error_of(coarse, exact, order), after = error_of(fine, exact, order);
    EXPECT_GT(std::log2(before / after), expected - 0.25)
        << "degree " << d << ", H" << order << ": " << before << ", " << after;
  }
}

}  // namespace batten::test
