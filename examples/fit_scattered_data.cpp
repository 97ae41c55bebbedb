// SPDX-License-Identifier: MIT
// Fit a surface to scattered data.
//
// Franke's function f is known at N = 2000 random points of the unit square. The smooth surface p of least energy
// through them minimises
//
//   E(p) = ∫∫ p_xx² + 2 p_xy² + p_yy²    subject to    p(x_i) = z_i
//
// among the cubic splines on 64 x 64 cells. The error of p is measured where no data are.
//
// Method: multigrid on B-splines (fem/fit.h). [Franke 1979] is the source of f.
// Output: the largest residual at the points and the root-mean-square error inside, below 1e-9 and 1e-3.
#include <batten/domains/rectangle.h>
#include <batten/fem/fit.h>

#include <cmath>
#include <iostream>
#include <random>

namespace {

double franke(double x, double y) {
  const double u = 9 * x, v = 9 * y;
  return 0.75 * std::exp(-(std::pow(u - 2, 2) + std::pow(v - 2, 2)) / 4) +
         0.75 * std::exp(-std::pow(u + 1, 2) / 49 - (v + 1) / 10) +
         0.5 * std::exp(-(std::pow(u - 7, 2) + std::pow(v - 3, 2)) / 4) -
         0.2 * std::exp(-std::pow(u - 4, 2) - std::pow(v - 7, 2));
}

batten::Observations measurements(int count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, 1);
  batten::Observations data;
  for (int i = 0; i < count; ++i) {
    data.x.push_back(place(random));
    data.y.push_back(place(random));
    data.value.push_back(franke(data.x.back(), data.y.back()));
  }
  return data;
}

// Root mean square of p - f on 81 x 81 places in the inner 80 % of the square.
double error_inside(const batten::Solution& p) {
  double sum = 0;
  int count = 0;
  for (int j = 0; j <= 80; ++j) {
    for (int i = 0; i <= 80; ++i, ++count) {
      const double x = 0.1 + 0.01 * i, y = 0.1 + 0.01 * j;
      sum += std::pow(p.value(x, y) - franke(x, y), 2);
    }
  }
  return std::sqrt(sum / count);
}

}  // namespace

int main() {
  // 1. The data, and the rectangle with its grid of cells.
  const batten::Observations data = measurements(2000);
  const batten::Rectangle square{batten::Interval(0, 1, 64), batten::Interval(0, 1, 64)};

  // 2. What is asked for: interpolation by a thin plate.
  batten::FitOptions options;
  options.energy = batten::Energy::thin_plate();
  options.smoothing = batten::Smoothing::none();

  // 3. The surface; its value and derivatives can be had anywhere.
  const batten::FitResult fit = batten::fit_surface(data, square, options);
  const double error = error_inside(fit.solution);
  std::cout << "energy            " << fit.energy << "\nlargest residual  " << fit.largest_residual
            << "\nerror inside      " << error << "\nslope at (½, ½)   " << fit.solution.derivative(0.5, 0.5, 1, 0)
            << ' ' << fit.solution.derivative(0.5, 0.5, 0, 1) << '\n';

  // 4. Interpolates, and is close to f between the points.
  return fit.largest_residual < 1e-6 && error < 1e-3 ? 0 : 1;
}
