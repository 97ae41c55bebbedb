// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/flow_masks.h>
#include <batten/bases/staggered_field.h>

#include <array>
#include <complex>
#include <vector>

namespace batten {

using Velocity = std::array<double, 2>;

/// The flows that the exact schemes tend to when a single coarse wall at the origin has the velocity 1, the others 0
/// [Warren & Weimer 2001, sec. 5.3.5]. With the generator g = (c_y, -c_x),
///   n_u = g(x, y + 1/2) - g(x, y - 1/2),   n_v = -g(x + 1/2, y) + g(x - 1/2, y):
/// two rotors of opposite sense beside the origin. For perfect flow c is the harmonic Green's function log(r²) / 4π, so
/// that n_u = (Re f, -Im f), f = 1 / (2π (z² + 1/4)), z = x + iy; it is infinite at its rotors. For slow flow c is the
/// five-point Laplacian of the biharmonic Green's function r² log(r²) / 16π; n_u is continuous.
///
/// Far out both are (Re, -Im) of 1 / (2π z²): sums over coarse fields converge conditionally only. Of a K x L block of
/// unit u the middle moves with (2/π) atan(K/L), not 1 [derived].
///
/// Relative errors, to the speed, are below 1e-14 (for slow flow absolute within r = 3, where the speed is about 1/10).
class FlowBasis {
public:
  explicit FlowBasis(Flow flow);

  Flow flow() const { return flow_; }
  Velocity n_u(double x, double y) const;
  Velocity n_v(double x, double y) const;
  Velocity generator(double x, double y) const;

private:
  using Complex = std::complex<double>;
  /// Σ_w weight g_2(z - w) over points w, with g_2 = (c_y, -c_x) of the biharmonic Green's function c; as u - iv.
  /// Linear functions are annihilated by the weights.
  class BiharmonicSum {
  public:
    struct Point {
      int twice_x, twice_y, weight;
    };
    BiharmonicSum() = default;
    explicit BiharmonicSum(std::vector<Point> points);
    Complex operator()(double x, double y) const;

  private:
    Complex near(double x, double y) const;
    Complex far(const Complex& z) const;

    std::vector<Point> points_;
    std::vector<Complex> plain_, times_conjugate_, conjugate_;  // factors of z^-p, of z̄ z^-p, and of z̄^-p
  };

  Flow flow_;
  BiharmonicSum slow_u_, slow_generator_;
};

/// Σ u(i,j) n_u((x, y) - its wall) + Σ v(i,j) n_v((x, y) - its wall), all in units of the spacing: the limit of the
/// exact scheme for a field that is at rest outside. The work is that of one basis function for each wall that moves.
Velocity flow_at(const FlowBasis& basis, const StaggeredField& field, double x, double y);

}  // namespace batten
