// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_system.h>
#include <batten/fem/sparse_cholesky.h>

#include <Eigen/SparseCore>

#include <optional>
#include <span>
#include <vector>

namespace batten {

/// The splines that vanish at the supports of a system, C v = 0 with the values C at its points, and the way into them:
/// the change of least v · D v, D the diagonal of the system's matrix A. It is local. Added to a preconditioner of A
/// with stiff springs at the points, P B P^T, it leaves one of A on these splines: what springs leave to do is small.
class SupportProjection {
public:
  explicit SupportProjection(const BoundarySystem& system);

  bool is_identity() const { return !factor_; }
  /// P v = v - D^-1 C^T (C D^-1 C^T)^-1 C v.
  void project(std::span<double> v) const;
  /// P^T r.
  void project_transposed(std::span<double> r) const;
  /// The v of least v · D v that takes these values at the points, in their order in the system.
  std::vector<double> lifting(std::span<const double> values) const;

private:
  Eigen::SparseMatrix<double> values_;   // C^T
  Eigen::SparseMatrix<double> answers_;  // D^-1 C^T
  std::optional<SparseCholesky> factor_;
};

}  // namespace batten
