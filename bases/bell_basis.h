// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask.h>

#include <array>
#include <vector>

namespace batten {

/// c_m = r^(2m-2) log(r²) / (4π 4^(m-1) ((m-1)!)²), r² = x² + y²: the Green's function of Δ^m, m = order >= 1
/// [Warren & Weimer 2001, sec. 5.1.1]. At the origin -∞ for m = 1, else 0.
double polyharmonic_green(int order, double x, double y);

/// The bell-shaped basis function n = Σ_ij (l^m)[i,j] c_m(x - i, y - j) of the polyharmonic scheme of order m, l the
/// five-point Laplacian [Warren & Weimer 2001, sec. 5.1.2]. It has the symmetries of the square, is C^(2m-3), and its
/// integer translates sum to 1. For m = 1 it has logarithmic spikes, at 0 to +∞, at the four neighbours to -∞.
///
/// Far out n = -(m / 2π) cos(4φ) r^-4 + O(r^-6) [derived]. Σ_i p(i) n(x - i) therefore converges absolutely for
/// polynomials of degree <= 1, to p(x). Over growing discs around x it converges for degrees 2 and 3, for m >= 2 to
/// p + (m/16) Δp, not to p as the source supposes; for m = 1 to a function with a spike at every grid point. From
/// degree 4 on it diverges, although the mask has zeros of order 2m.
///
/// For r <= 1.25 m absolute errors are below 1e-14 (those of gradients next to a spike relative to them), beyond they
/// are below 1e-14 r^-4, r^-5 and r^-6 times a small constant for value, gradient and Laplacian.
class BellBasis {
public:
  /// Throws InvalidInput unless 1 <= order <= 8.
  explicit BellBasis(int order);

  int order() const { return order_; }
  double value(double x, double y) const;
  /// (∂n/∂x, ∂n/∂y); not a number on the spikes of m = 1.
  std::array<double, 2> gradient(double x, double y) const;
  /// Δn, for m = 2 infinite at the 13 grid points of l². Zero for m = 1 but for point masses at five grid points, which
  /// do not show.
  double laplacian(double x, double y) const;

private:
  /// Real part of ζ̄^α ζ^-β Σ_k terms[k] ζ^-4k, ζ = (x + iy) / m: a part of the series far out.
  struct FarPart {
    int alpha, beta;
    std::vector<double> terms;
  };
  bool is_far(double x, double y) const;

  int order_;
  Mask2<double> differences_;  // l^m
  std::vector<FarPart> far_;
};

/// The bell of order 1 in polar coordinates, log(1 + r^-8 - 2 cos(4 angle) r^-4) / (4π) [derived].
double harmonic_bell(double r, double angle);

}  // namespace batten
