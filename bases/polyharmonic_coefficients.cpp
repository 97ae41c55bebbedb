// SPDX-License-Identifier: MIT
#include <batten/bases/polyharmonic_coefficients.h>
#include <batten/bases/polyharmonic_residual.h>
#include <batten/domains/errors.h>

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <utility>

// Fix ω, u = sin²(ω/2), Y = y + 1/y. With P = 4u + 2 - Y, so that l = -P where x = e^(iω), long division by P leaves
//   l[x²,y²] / l[x,y] = 4c - P - 32 u² / P,   2c = 4u + 2.
// The power m of this is Σ_e r_e(u) P^e, e = -m .. m. The coefficient of y^j in P^-k is made of powers of e^(-j α),
// cosh α = c; what remains is one integral over ω,
//   s[i,j] = 4^(1-m) / π ∫_0^π cos(iω) Σ_e r_e(u) [y^j] P^e dω,
// of a function that is analytic for 0 <= ω <= π, as α = 2 arsinh(sin(ω/2)) is. For i <= j it falls faster than it
// oscillates, and all factors of one e have the same sign: nothing is lost to cancellation.

namespace batten {
namespace {

constexpr int largest_order = 8;

double binomial(int n, int k) {
  double result = 1;
  for (int t = 1; t <= k; ++t) result = result * (n - k + t) / t;
  return result;
}

/// [y^j] P^e, e >= 0, P = 2c - y - 1/y.
double coefficient_of_power(int e, int j, double two_c) {
  double sum = 0;
  for (int a = 0; j + 2 * a <= e; ++a) {  // a factors 1/y, j + a factors y
    const int b = e - j - 2 * a;
    sum += binomial(e, a) * binomial(e - a, j + a) * std::pow(two_c, b);
  }
  return (j % 2 == 0 ? 1 : -1) * sum;
}

/// [y^j] P^-k, k >= 1: μ^(k+j) C(j+k-1, k-1) F(k, j+k; j+1; μ²), μ = e^-α, by Pfaff's transformation of the
/// hypergeometric function F a finite sum of positive terms.
double coefficient_of_inverse_power(int k, int j, double u) {
  const double two_sinh = 4 * std::sqrt(u * (1 + u));
  const double alpha = 2 * std::asinh(std::sqrt(u));
  const double ratio = std::exp(-alpha) / two_sinh;
  double term = 1, sum = 1;
  for (int t = 0; t + 1 < k; ++t) {
    term *= ratio * (k + t) * (k - 1 - t) / ((j + 1. + t) * (t + 1));
    sum += term;
  }
  return std::exp(-j * alpha) * binomial(j + k - 1, k - 1) * std::pow(two_sinh, -k) * sum;
}

/// r_e(u) of (4c - P - 32u²/P)^m: a factors P and a - e factors 32u²/P.
double factor_of_power(int m, int e, double u) {
  const double remainder = 32 * u * u, four_c = 8 * u + 4;
  double sum = 0;
  for (int a = std::max(e, 0); 2 * a - e <= m; ++a)
    sum += binomial(m, a) * binomial(m - a, a - e) * std::pow(remainder, a - e) * std::pow(four_c, m - 2 * a + e);
  return (e % 2 == 0 ? 1 : -1) * sum;
}

/// Σ_e r_e(u) [y^j] P^e.
double row_coefficient(int m, int j, double u) {
  double sum = 0;
  for (int e = j; e <= m; ++e) sum += factor_of_power(m, e, u) * coefficient_of_power(e, j, 4 * u + 2);
  for (int k = 1; k <= m; ++k) sum += factor_of_power(m, -k, u) * coefficient_of_inverse_power(k, j, u);
  return sum;
}

}  // namespace

double polyharmonic_coefficient(int order, int i, int j) {
  require_order("polyharmonic_coefficient", order);
  if (order > largest_order)
    throw InvalidInput("polyharmonic_coefficient: the order must be at most " + std::to_string(largest_order) +
                       ", found " + std::to_string(order));
  i = std::abs(i);
  j = std::abs(j);
  if (i > j) std::swap(i, j);
  const auto integrand = [order, i, j](double omega) {
    const double s = std::sin(omega / 2);
    return std::cos(i * omega) * row_coefficient(order, j, s * s);
  };
  // Panels within which cos(iω) e^(-jα) is tame; e^(-jα) < 1e-30 beyond the last.
  constexpr double pi = std::numbers::pi;
  const double end = std::min(pi, 120. / std::max(j, 1)), width = std::min(pi / 4, 3. / std::max(j, 1));
  const int panels = static_cast<int>(std::ceil(end / width));
  double sum = 0;
  for (int p = panels; p-- > 0;)  // small contributions first
    sum += boost::math::quadrature::gauss<double, 20>::integrate(integrand, p * end / panels, (p + 1) * end / panels);
  return std::pow(4., 1 - order) / pi * sum;
}

}  // namespace batten
