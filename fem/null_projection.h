// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/data_term.h>

#include <Eigen/Dense>

#include <span>
#include <vector>

namespace batten {

/// Splits off the null space of an energy, orthogonally in the data's inner product (u, v) = (B u)^T W (B v).
///
/// For a very large λ the rounding of λ E exceeds the data part on the null space; the iteration then runs in its
/// complement, where the energy alone is definite, and the component in the null space is found from the data.
class NullProjection {
public:
  /// `degree`: of the polynomials without energy, 0, 1 or 2. Constants are left alone where no measurement sees them.
  NullProjection(const SplineSpace& space, const DataTerm& data, int degree);

  /// c - N (N^T M N)^-1 N^T M c with M = B^T W B: the part of c in the complement.
  void project(std::span<double> c) const;
  /// The transposed projection, for right-hand sides and residuals.
  void project_transposed(std::span<double> r) const;
  /// Sets the component of c in the null space so that the residual b - M c is orthogonal to it, as at the solution.
  void set_component(std::span<const double> b, std::span<double> c) const;

private:
  Eigen::MatrixXd functions_;  // N: coefficients of the polynomials
  Eigen::MatrixXd products_;   // M N
  Eigen::MatrixXd inverse_;    // (N^T M N)^-1
};

}  // namespace batten
