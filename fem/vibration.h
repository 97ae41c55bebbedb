// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_solver.h>

#include <vector>

namespace batten {

/// A mode of free vibration: a(u, v) = eigenvalue ∫∫ density u v for all v.
struct Mode {
  double eigenvalue = 0;  ///< the square of the angular frequency
  Solution shape;         ///< ∫∫ density u² = 1, its largest value positive
  double residual = 0;    ///< estimated relative error of the eigenvalue
};

/// The `count` lowest modes of the membrane or plate with homogeneous side conditions; rigid motions, eigenvalue 0,
/// come first where the sides allow them. Loads are ignored. Throws InvalidInput for a count that is not between 1 and
/// the number of unknowns / 8, and for a density that is not positive.
std::vector<Mode> vibration_modes(const BoundaryProblem& problem, int count, const Field& density = 1,
                                  const BoundarySolveOptions& options = {});

}  // namespace batten
