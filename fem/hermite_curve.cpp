// SPDX-License-Identifier: MIT
#include <batten/fem/hermite_curve.h>

#include <algorithm>
#include <cmath>

namespace batten {

double HermiteCurve::value(double t) const {
  const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, t);
  const auto k = static_cast<std::size_t>(above - knots.begin()) - 1;
  const double h = knots[k + 1] - knots[k], u = (t - knots[k]) / h, v = 1 - u;
  return v * v * ((1 + 2 * u) * values[k] + u * h * slopes[k]) +
         u * u * ((1 + 2 * v) * values[k + 1] - v * h * slopes[k + 1]);
}

double CubicCell::value(double x) const {
  return left + x * (slope_left() + x * (bend_left / 2 + x * (bend_right - bend_left) / (6 * width)));
}

double CubicCell::lowest() const {
  double best = right < left ? width : 0;
  // Roots of slope + bend_left x + third x² / 2.
  const double slope = slope_left(), third = (bend_right - bend_left) / width;
  const double square = bend_left * bend_left - 2 * third * slope;
  if (square < 0) return best;
  const double q = bend_left < 0 ? -bend_left + std::sqrt(square) : -bend_left - std::sqrt(square);
  for (const double x : {q / third, 2 * slope / q})
    if (x > 0 && x < width && value(x) < value(best)) best = x;
  return best;
}

}  // namespace batten
