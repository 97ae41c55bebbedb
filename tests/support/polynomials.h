// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/operator.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace batten::test {

/// p(s, t) = Σ a[i][j] s^i t^j in normalised coordinates.
using Polynomial = std::vector<std::vector<double>>;

/// Coefficients of u^k in a clamped basis by the polar form at the knots, [0, length] mapped to [0, cells]; degree up
/// to 3.
inline std::vector<double> monomial_coefficients(const SplineBasis& basis, double h, std::size_t k) {
  const auto breakpoints = basis.interval().breakpoints();
  const int d = basis.degree(), cells = basis.interval().cells();
  std::vector<double> c;
  for (int i = 0; i < basis.size(); ++i) {
    // elementary symmetric polynomials of the d inner knots of function i
    std::array<double, 4> e = {1, 0, 0, 0};
    for (int q = 1; q <= d; ++q) {
      const double knot = h * breakpoints[static_cast<std::size_t>(std::clamp(i + q - d, 0, cells))];
      for (std::size_t m = 3; m > 0; --m) e[m] += knot * e[m - 1];
    }
    const std::array<double, 4> binomial =
        d == 3 ? std::array<double, 4>{1, 3, 3, 1} : std::array<double, 4>{1, 2, 1, 0};
    c.push_back(e[k] / binomial[k]);
  }
  return c;
}

inline std::vector<double> polynomial_coefficients(const SplineSpace& space, const Polynomial& a) {
  std::vector<double> c(space.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < a[i].size(); ++j) {
      if (a[i][j] == 0) continue;
      const auto x = monomial_coefficients(space.x, space.hx, i), y = monomial_coefficients(space.y, space.hy, j);
      for (std::size_t q = 0; q < y.size(); ++q)
        for (std::size_t p = 0; p < x.size(); ++p) c[q * x.size() + p] += a[i][j] * x[p] * y[q];
    }
  return c;
}

/// The energy of p on the unit square, from the integrals of monomials.
inline double polynomial_energy(const Energy& energy, const Polynomial& a) {
  double sum = 0;
  for (const auto& term : energy.terms()) {
    Polynomial d = a;
    const auto falling = [](std::size_t n, int order) {
      double f = 1;
      for (int k = 0; k < order; ++k) f *= static_cast<double>(n) - k;
      return f;
    };
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < a[i].size(); ++j) d[i][j] *= falling(i, term.x_order) * falling(j, term.y_order);
    double square = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < a[i].size(); ++j)
        for (std::size_t k = 0; k < a.size(); ++k)
          for (std::size_t l = 0; l < a[k].size(); ++l) {
            const double product = d[i][j] * d[k][l];
            if (product == 0) continue;
            square += product / (static_cast<double>(i + k) - 2 * term.x_order + 1) /
                      (static_cast<double>(j + l) - 2 * term.y_order + 1);
          }
    sum += term.weight * square;
  }
  return sum;
}

}  // namespace batten::test
