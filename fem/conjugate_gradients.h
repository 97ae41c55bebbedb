// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/multigrid.h>

#include <span>
#include <vector>

namespace batten {

struct IterationLimits {
  double accuracy =
      1e-10;  ///< asked estimated relative error in the energy norm, sqrt(r·Br) / sqrt(b·Bb), B the V-cycle
  int most_iterations = 500;
};

struct IterationResult {
  int iterations = 0;   ///< V-cycles spent
  double accuracy = 0;  ///< reached: sqrt(r·Br) / sqrt(b·Bb) with r recomputed from the operator
};

/// Solves A c = b by conjugate gradients preconditioned with the V-cycle; `c` holds the start and receives the
/// solution.
///
/// The error is measured in the energy norm; the 2-norm of the residual of a plate stalls by rounding far above what is
/// reached. When the recursive residual says that the goal is reached, the residual is recomputed; if the two differ
/// tenfold the iteration restarts once. The reference b·Bb is the `scale` given, or that of the right-hand side if it
/// is 0. Throws SolverError if a direction of negative energy shows that the system is not positive definite.
IterationResult solve(const Multigrid& system, std::span<const double> b, std::span<double> c,
                      const IterationLimits& limits = {}, double scale = 0);

/// sqrt(b·Bb): the size of a right-hand side in the norm that `solve` uses. One V-cycle.
double energy_size(const Multigrid& system, std::span<const double> b);

}  // namespace batten
