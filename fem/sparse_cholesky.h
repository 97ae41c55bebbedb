// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/SparseCore>

#include <memory>
#include <span>

namespace batten {

/// Factorisation L L^T of a sparse symmetric positive definite matrix (CHOLMOD, simplicial: one thread, the same bits
/// always).
class SparseCholesky {
public:
  /// `lower` holds the lower triangle. Throws SolverError if the matrix is not positive definite.
  explicit SparseCholesky(const Eigen::SparseMatrix<double>& lower);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  int size() const;
  /// Replaces b by the solution x of A x = b.
  void solve(std::span<double> b) const;

private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace batten
