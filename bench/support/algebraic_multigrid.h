// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/SparseCore>

#include <span>

namespace batten {

/// False in a build without hypre.
bool has_algebraic_multigrid();

struct AlgebraicMultigridCost {
  double set_up = 0, solution = 0;  ///< seconds
  int iterations = 0;
};

/// Conjugate gradients preconditioned by hypre's BoomerAMG with its defaults (one process), from 0 until the residual
/// is `accuracy` times the right-hand side in the preconditioner's norm. `lower`: the lower triangle of a symmetric
/// matrix, compressed. Throws std::runtime_error in a build without hypre.
AlgebraicMultigridCost solve_by_algebraic_multigrid(const Eigen::SparseMatrix<double>& lower, std::span<const double> b,
                                                    double accuracy);

}  // namespace batten
