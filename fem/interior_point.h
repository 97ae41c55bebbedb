// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/feasible_set.h>

#include <functional>

namespace batten {

struct InteriorPointOptions {
  double gap = 1e-3;        ///< asked of InteriorPointResult::gap
  double least_energy = 0;  ///< energies below count as this one
  int most_steps = 80;
  /// Called before each step with the part of the way that is done, 0 to 1, in decades of the gap.
  std::function<void(double done)> progress;
};

struct InteriorPointResult {
  /// False where steps became short far outside the set, which is empty then, or nearly so.
  bool converged = false;
  int steps = 0;         ///< each with one set of weights and two directions
  double energy = 0;     ///< J at the end
  double gap = 0;        ///< (energy - bound) / max(energy, least_energy); the bound is proved by `force` alone
  double violation = 0;  ///< beyond the set, in units; 0 where converged
  std::vector<double> force;
};

/// The least J(c) with B c in the set, by a primal-dual interior-point method with predictor and corrector
/// [Mehrotra 1992] from any start. Directions need be neither exact nor of the same error: what they leave is in the
/// residuals of the next step, and the bound at the end is one of its own. The set's variables must have been started.
InteriorPointResult minimise(ConstrainedEnergy& energy, FeasibleSet& set, const InteriorPointOptions& options = {});

}  // namespace batten
