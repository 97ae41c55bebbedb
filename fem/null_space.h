// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/operator.h>

#include <array>
#include <span>

namespace batten {

/// A linear (or constant) function a + b (x - x0) + c (y - y0): an element of the null space of an energy.
struct LinearFunction {
  double a = 0, b = 0, c = 0;
  double x0 = 0, y0 = 0;

  double operator()(double x, double y) const { return a + b * (x - x0) + c * (y - y0); }
  /// Adds this function to the spline with the given coefficients: those of a linear function are its values at the
  /// Greville abscissae.
  void add_to(const SplineSpace& space, std::span<double> coefficients) const;
};

/// A quadratic function in normalised coordinates from a centre of its own, s = (x - x0) / length, t = (y - y0) /
/// length: Σ_k c_k m_k, m = 1, s, t, s², s t, t².
struct QuadraticFunction {
  std::array<double, 6> c{};
  double x0 = 0, y0 = 0, length = 1;

  double operator()(double x, double y) const;
  /// Adds this function to the spline with the given coefficients, of degree 2 or more.
  void add_to(const SplineSpace& space, std::span<double> coefficients) const;
};

/// How far points (x[i], y[i]) are from lying on one line: smallest over largest principal extent, 0 on a line, 1 for a
/// disc.
double flatness(std::span<const double> x, std::span<const double> y);

/// The function of the null space of degree 0 or 1 closest to the values in the weighted least-squares sense.
/// Points on one line leave the slope across it 0.
LinearFunction fit_null_space(int degree, std::span<const double> x, std::span<const double> y,
                              std::span<const double> values, std::span<const double> weights);

}  // namespace batten
