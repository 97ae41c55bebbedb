// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_problem.h>
#include <batten/fem/conjugate_gradients.h>
#include <batten/fem/phase_time.h>
#include <batten/fem/solution.h>

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace batten {

struct BoundarySolveOptions {
  IterationLimits limits;
  /// Called now and then with the phase ("assemble", "solve", ...) and the part of it that is done, 0 to 1.
  std::function<void(std::string_view phase, double done)> progress;
};

struct BoundaryResult {
  Solution solution;
  double energy = 0;      ///< a(u, u): the energy of the material, twice the strain energy of a plate
  double compliance = 0;  ///< b·u: the work of the loads on u, natural boundary data included
  std::array<double, 4> side_reactions = {};  ///< force of the left, right, bottom, top side on the plate (or its
                                              ///< flux into the domain); 0 where nothing is prescribed
  std::vector<double> point_reactions;        ///< of the supports, in their order
  std::vector<double> line_reactions;
  std::size_t unknowns = 0;
  int levels = 0;
  int iterations = 0;              ///< V-cycles, those on coarse levels in units of the finest
  double accuracy = 0;             ///< reached: estimated relative error in the energy norm
  std::vector<std::string> notes;  ///< what the user should know, one line each
  std::vector<PhaseTime> seconds;
};

/// The spline that minimises a(u, u) / 2 - b·u under the conditions of the problem. Throws InvalidInput where the
/// problem is not well posed (sides that contradict each other, a membrane or plate that can move freely under loads
/// that are not balanced, coefficients out of range, points outside), naming the entry and what was found; SolverError
/// if the iteration fails.
BoundaryResult solve_boundary_problem(const BoundaryProblem& problem, const BoundarySolveOptions& options = {});

}  // namespace batten
