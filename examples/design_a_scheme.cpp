// SPDX-License-Identifier: MIT
// Design a subdivision scheme, prove how smooth it is, and solve a differential equation with it.
//
// The mask is the mean of two old acquaintances, the cubic B-spline and the interpolating four-point scheme:
//
//   s = (cubic + four-point) / 2 = -1/32 x^-3 + 1/16 x^-2 + 17/32 x^-1 + 7/8 + 17/32 x + 1/16 x^2 - 1/32 x^3.
//
// Both have the factor (1 + x)^4, so s has sum rules of order 4: its limits hold all cubics. Galerkin's method for
// u'' = f on a circle of length 1, u = Σ c_i n(x / h - i) with h = 1 / N, reads
//
//   K c = -h² L,   K_ij = ∫ n'(t - i) n'(t - j) dt,   L_i = ∫ f(h t) n(t - i) dt,
//
// and the error of u against the exact solution falls like h^4. Everything but f is exact: the inner products come from
// the refinement equation, and Σ_j n(j) f(h (i + j)) integrates cubics f exactly because of the sum rules.
//
// Output: the verdict on smoothness with its proof, and the order of convergence between N = 16 .. 128, 4 +- 0.1.
#include <batten/bases/bspline_scheme.h>
#include <batten/bases/inner_products.h>
#include <batten/bases/interpolatory_schemes.h>
#include <batten/bases/scaling_values.h>
#include <batten/bases/smoothness.h>

#include <Eigen/Dense>

#include <cmath>
#include <iostream>
#include <numbers>

namespace {

constexpr double wave = 2 * std::numbers::pi;

/// The circulant matrix Σ_k entry[k] (shift by k).
Eigen::MatrixXd circulant(const batten::Mask<batten::Rational>& entry, int n) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i)
    for (int k = entry.first()[0]; k <= entry.last()[0]; ++k)
      matrix(i, ((i + k) % n + n) % n) += static_cast<double>(entry[k]);
  return matrix;
}

/// The largest error of u at the nodes, for u(x) = exp(sin(2 π x)) less its mean there.
double error(const batten::Scheme& scheme, int n) {
  const batten::Factor<1> derivative{scheme, {1}};
  const Eigen::MatrixXd stiffness = circulant(batten::inner_products(derivative, derivative), n);
  const Eigen::MatrixXd values = circulant(batten::values_at_integers(scheme), n);  // symmetric, as n is even
  const double h = 1. / n;
  Eigen::VectorXd u(n), f(n);
  for (int i = 0; i < n; ++i) {
    const double s = std::sin(wave * i * h), c = std::cos(wave * i * h);
    u[i] = std::exp(s);
    f[i] = wave * wave * (c * c - s) * u[i];
  }
  // Constants are left open by u'': the mean of c is set to 0, as ones^T c = 0 is added to every equation.
  const Eigen::MatrixXd system = stiffness + Eigen::MatrixXd::Ones(n, n);
  const Eigen::VectorXd load = values * f;
  const Eigen::VectorXd c = system.ldlt().solve(-h * h * (load.array() - load.mean()).matrix());
  const Eigen::VectorXd difference = values * c - u;
  return (difference.array() - difference.mean()).abs().maxCoeff();
}

}  // namespace

int main() {
  using batten::Rational;
  const auto mask =
      Rational(1, 2) * (batten::centred(batten::bspline_mask(4)) + batten::four_point_scheme().exact_mask());
  const batten::Scheme scheme("mean of cubic and four-point", mask);

  const auto verdict = batten::smoothness(scheme);
  std::cout << scheme.name() << ": " << batten::explanation(verdict, scheme.arity()) << '\n';
  bool fine = verdict.continuity == 2 && verdict.is_decided();

  double before = 0;
  for (int n = 16; n <= 128; n *= 2) {
    const double now = error(scheme, n);
    std::cout << "N = " << n << ": error " << now;
    if (before > 0) std::cout << ", order " << std::log2(before / now);
    std::cout << '\n';
    if (n > 32) fine = fine && std::abs(std::log2(before / now) - 4) < 0.1;
    before = now;
  }
  return fine ? 0 : 1;
}
