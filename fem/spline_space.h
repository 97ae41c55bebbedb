// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/spline_basis.h>
#include <batten/bases/tensor_sum.h>

#include <cmath>
#include <cstddef>
#include <span>

namespace batten {

/// The tensor-product spline space of one level: coefficient (i, j) has index i + j * x.size().
struct SplineSpace {
  SplineBasis x, y;
  double hx = 1, hy = 1;  ///< lengths of the finest cells in normalised coordinates

  /// Factor that turns ∫∫ (∂_x^a ∂_y^b p)² in cells into normalised coordinates.
  double cell_factor(int a, int b) const { return std::pow(hx, 1 - 2 * a) * std::pow(hy, 1 - 2 * b); }

  std::size_t size() const { return static_cast<std::size_t>(x.size()) * static_cast<std::size_t>(y.size()); }
  /// Functions that the conditions at the ends leave.
  std::size_t kept() const { return static_cast<std::size_t>(x.kept()) * static_cast<std::size_t>(y.kept()); }
  bool is_removed(int i, int j) const { return x.is_removed(i) || y.is_removed(j); }
  bool holds_constants() const { return x.holds_constants() && y.holds_constants(); }
  /// True if the space holds all splines of its degree.
  bool is_unconstrained() const { return x.ends().are_free() && y.ends().are_free(); }

  bool is_periodic() const { return x.is_periodic() || y.is_periodic(); }
  /// The coefficient whose image (i, j) is, or that of (i, j) itself.
  std::size_t original(int i, int j) const {
    return static_cast<std::size_t>(y.original(j)) * static_cast<std::size_t>(x.size()) +
           static_cast<std::size_t>(x.original(i));
  }
};

/// Of a periodic space: coefficients take the values of the originals where they are images.
void fill_images(const SplineSpace& space, std::span<double> coefficients);
/// Of a periodic space: adds what integrals hold at images to their originals and leaves 0 there.
void fold_images(const SplineSpace& space, std::span<double> integrals);

/// T^T of a space with conditions at its ends: T holds the coefficients of its functions among all splines. Image by
/// image where it is periodic.
TensorSum subspace_restriction(const SplineSpace& space);
/// T c in place: coefficients of the space's functions become those of all splines.
void to_unconstrained(const SplineSpace& space, std::span<double> coefficients);

}  // namespace batten
