// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace batten {

/// A quadratic energy of a function p on the plane, Σ_t weight_t ∫∫ (∂_x^{a_t} ∂_y^{b_t} p)^2, in normalised
/// coordinates.
///
///   thin plate  p_xx² + 2 p_xy² + p_yy²   null space: linear functions
///   membrane    p_x² + p_y²               null space: constants
///   tension     (1 - T) thin plate + T membrane
class Energy {
public:
  struct Term {
    double weight;
    int x_order, y_order;  ///< orders of the derivatives a and b, at most 2
  };

  static Energy thin_plate();
  static Energy membrane();
  /// Throws InvalidInput unless 0 <= tension <= 1; 0 gives the thin plate, 1 the membrane.
  static Energy tension(double tension);
  /// Any other such sum. Throws InvalidInput unless there is a term, weights are finite and positive, orders are from 0
  /// to 2 and not both 0 (the mass is no energy: it has no null space).
  static Energy sum_of(std::vector<Term> terms);

  const std::vector<Term>& terms() const { return terms_; }
  /// Highest order of the derivatives that occur.
  int order() const;
  /// Degree of the polynomials without energy: 1 (constant and linear functions) or 0 (constants). A sum without mixed
  /// derivative has x y besides: SplineLevel::null_monomials knows all.
  int null_degree() const;

private:
  explicit Energy(std::vector<Term> terms) : terms_(std::move(terms)) {}
  std::vector<Term> terms_;
};

}  // namespace batten
