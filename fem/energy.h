// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace batten {

/// A quadratic energy of a function p on the plane,
///
///   Σ_t weight_t ∫∫ (∂_x^{a_t} ∂_y^{b_t} p)²  +  curvature ∫∫ 2 (p_xx p_yy - p_xy²),
///
/// in normalised coordinates. The second integral, the Gaussian curvature of flat plates, depends on the sides only and
/// is what Poisson's ratio contributes to a plate.
///
///   third derivatives  p_xxx² + 3 p_xxy² + 3 p_xyy² + p_yyy²   null space: quadratic functions
///   thin plate  p_xx² + 2 p_xy² + p_yy²   null space: linear functions
///   membrane    p_x² + p_y²               null space: constants
///   tension     (1 - T) thin plate + T membrane
class Energy {
public:
  struct Term {
    double weight;
    int x_order, y_order;  ///< orders of the derivatives a and b, at most 3
  };

  static Energy thin_plate();
  static Energy membrane();
  /// The next one of the row membrane, thin plate, ...: the squared third derivatives in all directions.
  static Energy third_derivatives();
  /// Throws InvalidInput unless 0 <= tension <= 1; 0 gives the thin plate, 1 the membrane.
  static Energy tension(double tension);
  /// Any other such sum. Throws InvalidInput unless there is a term, weights are finite and positive, orders are from 0
  /// to 3 and not both 0 (the mass is no energy: it has no null space).
  static Energy sum_of(std::vector<Term> terms);
  /// k (p_x² + p_y²) + c p². Throws InvalidInput unless k > 0 and c >= 0, both finite.
  static Energy conduction(double k, double c);
  /// D (p_xx² + 2 ν p_xx p_yy + p_yy² + 2 (1 - ν) p_xy²) + T (p_x² + p_y²) + c p², the Kirchhoff plate. Throws
  /// InvalidInput unless D > 0, -1 <= ν <= 0.5, T >= 0 and c >= 0, all finite. At ν = -1 x² + y² has no energy beside
  /// the linear functions, unless sides hold it.
  struct Plate {
    double rigidity = 1, poisson_ratio = 0.3, tension = 0, foundation = 0;
  };
  static Energy plate(const Plate& plate);
  /// The same energy for coordinates that are divided by `length`.
  Energy scaled(double length) const;

  const std::vector<Term>& terms() const { return terms_; }
  double curvature() const { return curvature_; }
  /// Highest order of the derivatives that occur.
  int order() const;
  /// Degree of the polynomials without energy: 2 (quadratic functions), 1 (linear ones), 0 (constants) or -1 (none). A
  /// sum without mixed derivative has x y besides: SplineLevel::null_monomials knows all.
  int null_degree() const;

private:
  explicit Energy(std::vector<Term> terms, double curvature = 0) : terms_(std::move(terms)), curvature_(curvature) {}
  std::vector<Term> terms_;
  double curvature_ = 0;
};

}  // namespace batten
