// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <functional>
#include <span>

namespace batten {

/// K x = θ M x by what K, M and a preconditioner B, an approximate inverse of K, do to a vector: all symmetric, K and M
/// positive definite on the space that B maps into.
struct EigenProblem {
  using Action = std::function<void(std::span<const double> in, std::span<double> out)>;
  Action stiffness, mass, precondition;
};

struct EigenOptions {
  int wanted = 1;
  double accuracy = 1e-10;  ///< asked of the estimated relative errors of θ - shift
  double shift = 0;         ///< less than the lowest θ
  int most_iterations = 500;
  std::function<void(double worst_error)> progress;  ///< called after each iteration
};

struct Eigenpairs {
  Eigen::VectorXd values;   ///< θ, ascending
  Eigen::MatrixXd vectors;  ///< columns, x_i·M x_j = δ_ij; as many as the start had
  Eigen::VectorXd errors;   ///< estimated relative errors of values - shift
  int iterations = 0;
  int preconditionings = 0;  ///< how often B was applied
};

/// The lowest eigenpairs by LOBPCG [Knyazev 2001]: in each step Rayleigh and Ritz choose from the span of the vectors
/// X, the directions P they last moved in and the preconditioned residuals W = B (K X - M X Θ).
///
/// `start`: linearly independent columns in the space that B maps into, more than are wanted: the others guard the
/// wanted ones, whose convergence depends on the gap to the first value beyond the block. A vector that has converged
/// moves on without a residual of its own. The estimated error of θ is that of its residual, r·B r, over 1 - θ /
/// θ_last.
///
/// Throws SolverError where the iteration ends without the asked accuracy.
Eigenpairs lowest_eigenpairs(const EigenProblem& problem, Eigen::MatrixXd start, const EigenOptions& options);

}  // namespace batten
