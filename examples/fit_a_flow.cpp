// SPDX-License-Identifier: MIT
// Find the flux through a channel from noisy velocities.
//
// Between two walls at rest, y = 0 and y = 1, an incompressible fluid flows from left to right. Its velocity has been
// measured at 300 places, with errors of 0.05 in each component. Sought is the field
//
//   v = (ψ_y, -ψ_x) that minimises  Σ |v(x_i) - v_i|² / (2 n) + λ ∫∫ ψ_xxx² + 3 ψ_xxy² + 3 ψ_xyy² + ψ_yyy²,
//
// which has no divergence because it is a rotation. ψ is constant on each wall, and what flows through is the
// difference of the two constants; nobody measured it.
// 1. fit without walls: the flux through different sections differs, since fluid leaves through the walls;
// 2. say that there are walls: the flux is one number, an unknown of the fit. λ is chosen by cross-validation.
//
// Output: the flux through three sections without walls, 0.98 to 1.01, and the flux with walls, 0.996; 1 is true.
#include <batten/flows/flow_fit.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <random>

namespace {

using batten::FlowSide;

/// ψ = y² (3 - 2 y) + 4 sin(4π x / 3) y² (1 - y)², of flux 1, at random places, with errors.
batten::VectorObservations measured() {
  std::mt19937 random(1);
  std::normal_distribution<double> error(0, 0.05);
  std::uniform_real_distribution<double> place(0, 1);
  batten::VectorObservations o;
  for (int i = 0; i < 300; ++i) {
    const double x = 3 * place(random), y = place(random), k = 4 * std::numbers::pi / 3;
    o.x.push_back(x);
    o.y.push_back(y);
    o.u.push_back(6 * y * (1 - y) + 8 * std::sin(k * x) * y * (1 - y) * (1 - 2 * y) + error(random));
    o.v.push_back(-4 * k * std::cos(k * x) * y * y * (1 - y) * (1 - y) + error(random));
  }
  return o;
}

double flux_at(const batten::FlowField& field, double x) {
  return field.stream_function(x, 1) - field.stream_function(x, 0);
}

}  // namespace

int main() {
  const batten::VectorObservations observations = measured();
  const batten::Rectangle channel{batten::Interval(0, 3, 96), batten::Interval(0, 1, 32)};

  const auto open = batten::fit_flow(observations, channel);
  std::cout << "without walls: flux";
  for (const double x : {0.5, 1.5, 2.5}) std::cout << ' ' << flux_at(open.field, x);

  batten::FlowOptions options;
  options.sides.bottom = options.sides.top = FlowSide::NoSlip;
  const auto fit = batten::fit_flow(observations, channel, options);
  double slip = 0;
  for (int k = 0; k <= 30; ++k) slip = std::max({slip, fit.field.speed(k / 10., 0), fit.field.speed(k / 10., 1)});
  std::cout << "\nwith walls:    flux " << *fit.flux << ", residual " << fit.rms_residual << ", speed at the walls "
            << slip << '\n';
  return std::abs(*fit.flux - 1) < 0.01 && slip < 1e-12 ? 0 : 1;
}
