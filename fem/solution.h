// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/grid_samples.h>
#include <batten/domains/record.h>
#include <batten/domains/rectangle.h>
#include <batten/fem/operator.h>

#include <array>
#include <span>
#include <vector>

namespace batten {

/// A tensor-product spline on a rectangle: p(x, y) = Σ c_ij N_i(x) N_j(y) in clamped B-splines of degree 1 to 5.
class Solution {
public:
  /// `coefficients`: (cells_x + degree) * (cells_y + degree) numbers, x fastest. Throws InvalidInput if their number
  /// differs, or for another degree.
  Solution(const Rectangle& region, int degree, std::vector<double> coefficients);

  const Rectangle& region() const { return region_; }
  int degree() const { return x_.degree(); }
  std::span<const double> coefficients() const { return coefficients_; }

  /// p(x, y); NaN outside the region.
  double value(double x, double y) const { return derivative(x, y, 0, 0); }
  /// ∂_x^a ∂_y^b p at (x, y), in the units of the data; where it jumps (an order equal to the degree) the limit from
  /// above; NaN outside the region.
  double derivative(double x, double y, int a, int b) const;

  /// Point arrays "value" (1 component) and "gradient" (3 components, the third 0; of degree 1, where it jumps, the
  /// mean of the limits) at the corners of the cells.
  GridSamples samples() const;

  /// kind "surface", array "coefficients"; add numbers and texts as you like.
  Record to_record() const;
  /// Throws InvalidInput if the record is of another kind or incomplete.
  static Solution from_record(const Record& record);

private:
  Rectangle region_;
  SplineBasis x_, y_;
  std::vector<double> coefficients_;
};

}  // namespace batten
