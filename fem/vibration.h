// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_solver.h>

#include <vector>

namespace batten {

/// A mode of free vibration: a(u, v) = eigenvalue ∫∫ density u v for all v that vanish where values are prescribed.
struct Mode {
  double eigenvalue = 0;  ///< the square of the angular frequency; of -div(k ∇u) + c u = eigenvalue density u
  Solution shape;         ///< ∫∫ density u² = 1, its largest coefficient positive
  double residual = 0;    ///< estimated relative error of the eigenvalue; that of the shape is its square root
};

struct Vibration {
  std::vector<Mode> modes;  ///< eigenvalues ascending
  std::size_t unknowns = 0;
  int iterations = 0;  ///< on the finest level
  int cycles = 0;      ///< V-cycles, those on coarse levels in units of the finest
  std::vector<PhaseTime> seconds;
};

/// The `count` lowest modes of the membrane or plate with homogeneous side conditions and supports at 0; rigid motions,
/// eigenvalue 0, come first where sides and supports allow them. Loads and prescribed values are ignored. Modes of one
/// eigenvalue are any orthonormal basis of its eigenspace.
///
/// options.limits.accuracy is asked of the estimated relative error of the eigenvalues. Throws InvalidInput for a count
/// that is not between 1 and the number of unknowns / 8, and for a density that is not positive; else as
/// solve_boundary_problem does.
Vibration vibration(const BoundaryProblem& problem, int count, const Field& density = 1,
                    const BoundarySolveOptions& options = {});

/// Their modes alone.
std::vector<Mode> vibration_modes(const BoundaryProblem& problem, int count, const Field& density = 1,
                                  const BoundarySolveOptions& options = {});

}  // namespace batten
