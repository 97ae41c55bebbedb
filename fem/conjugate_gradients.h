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
  int iterations = 0;   ///< V-cycles spent, those on coarse levels in units of the finest
  double accuracy = 0;  ///< reached: sqrt(r·Br) / sqrt(b·Bb) with r recomputed from the operator
};

/// Solves A c = b by conjugate gradients preconditioned with the V-cycle; `c` holds the start and receives the
/// solution. Without data and with constant coefficients (Multigrid::streamed) V-cycles alone do, as long as they
/// converge well. A start at 0 is replaced by the one of full multigrid, where that is sound (Multigrid::can_predict).
///
/// The error is measured in the energy norm; the 2-norm of the residual of a plate stalls by rounding far above what is
/// reached. The last residual is recomputed from the operator; if it says ten times more than the recursive one the
/// iteration restarts once. The reference is the `scale` given; if that is 0, sqrt(b·c) of the full multigrid's start,
/// the energy norm of the solution, or else sqrt(b·Bb). Throws SolverError if a direction of negative energy shows that
/// the system is not positive definite.
IterationResult solve(const Multigrid& system, std::span<const double> b, std::span<double> c,
                      const IterationLimits& limits = {}, double scale = 0);

/// Full multigrid from nothing: one V-cycle on each level (where data or varying coefficients ask for conjugate
/// gradients, one of their iterations on the finest level). What is left of the error is far less than that of the
/// discretisation where b and its solution are smooth; it is not measured.
void solve_by_levels(const Multigrid& system, std::span<const double> b, std::span<double> c);

/// sqrt(b·Bb): the size of a right-hand side in the norm that `solve` uses. One V-cycle.
double energy_size(const Multigrid& system, std::span<const double> b);

}  // namespace batten
