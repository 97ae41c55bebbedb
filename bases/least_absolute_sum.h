// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

namespace batten {

/// A solution x of A x = b with at most rows(A) entries other than zero: columns `basis`, their values `values`.
struct BasicSolution {
  std::vector<int> basis;
  Eigen::VectorXd values;
  /// Σ_j costs_j |x_j|
  double cost = 0;
};

/// A solution of A x = b for which Σ_j costs_j |x_j| is least, by the simplex method on the pairs ±x_j.
///
/// In doubles: a caller that needs a proof solves again for the basis in exact numbers, or bounds the residual. The
/// first rows(A) columns of A are a diagonal matrix without zeros, from which the search starts; costs are positive and
/// at least as many as columns. Throws SolverError when no optimum is found in 50 (rows + columns) steps.
BasicSolution least_absolute_sum(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::VectorXd>& b,
                                 const Eigen::Ref<const Eigen::VectorXd>& costs);

}  // namespace batten
