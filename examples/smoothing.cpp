// SPDX-License-Identifier: MIT
// Choose the smoothing by cross-validation.
//
// Measurements z_i = f(x_i) + noise of standard deviation σ at N random points. The surface p minimises
//
//   Σ_i (p(x_i) - z_i)² / N  +  λ E(p),    E the energy of the thin plate.
//
// A small λ follows the noise, a large one flattens f. Generalised cross-validation [Craven & Wahba 1979] finds a λ in
// between without knowing f or σ:
//
//   λ minimises  V(λ) = |z - p_λ|² / N  /  (1 - edf(λ) / N)²,   edf the effective degrees of freedom.
//
// Output: the root-mean-square error of p against f for a λ too small, the λ found, and a λ too large; the error for
// the λ found is the least of the three and less than half of σ; the residual is about σ sqrt(1 - edf / N).
#include <batten/domains/rectangle.h>
#include <batten/fem/fit.h>

#include <cmath>
#include <iostream>
#include <random>

namespace {

constexpr double sigma = 0.1;
constexpr int count = 1000;

double f(double x, double y) { return std::sin(6 * x) * std::cos(4 * y); }

batten::Observations measurements() {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(0, 1);
  std::normal_distribution<double> noise(0, sigma);
  batten::Observations data;
  for (int i = 0; i < count; ++i) {
    data.x.push_back(place(random));
    data.y.push_back(place(random));
    data.value.push_back(f(data.x.back(), data.y.back()) + noise(random));
  }
  return data;
}

// Root mean square of p - f at the data's places, where the noise is.
double error(const batten::Observations& data, const batten::FitResult& fit) {
  double sum = 0;
  for (std::size_t i = 0; i < data.size(); ++i) sum += std::pow(fit.fitted[i] - f(data.x[i], data.y[i]), 2);
  return std::sqrt(sum / static_cast<double>(data.size()));
}

}  // namespace

int main() {
  const batten::Observations data = measurements();
  const batten::Rectangle square{batten::Interval(0, 1, 64), batten::Interval(0, 1, 64)};

  const auto fit_with = [&](batten::Smoothing smoothing) {
    batten::FitOptions options;
    options.smoothing = smoothing;
    return batten::fit_surface(data, square, options);
  };
  const batten::FitResult automatic = fit_with(batten::Smoothing::automatic());
  const double found = error(data, automatic);
  const double rough = error(data, fit_with(batten::Smoothing::fixed(1e-3 * automatic.lambda)));
  const double stiff = error(data, fit_with(batten::Smoothing::fixed(1e3 * automatic.lambda)));
  const double residual = sigma * std::sqrt(1 - automatic.effective_degrees.value_or(0) / count);

  std::cout << "lambda found          " << automatic.lambda << "\nerror: too small      " << rough
            << "\nerror: found          " << found << "\nerror: too large      " << stiff << "\nresidual              "
            << automatic.rms_residual << "\nresidual expected     " << residual << '\n';
  const bool is_best = found < rough && found < stiff && found < sigma / 2;
  return is_best && std::abs(automatic.rms_residual - residual) < 0.1 * sigma ? 0 : 1;
}
