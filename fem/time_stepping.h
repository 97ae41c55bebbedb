// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_solver.h>

#include <functional>
#include <string>
#include <vector>

namespace batten {

/// Motion in time: for Poisson problems density u_t + A u = f (heat), for plates density w_tt + damping w_t + A w = q.
struct Motion {
  double end = 1, step = 0.1;  ///< the last step is shortened to end at `end`
  Field initial = 0;           ///< u at time 0, L2-projected onto the splines that keep sides and supports
  Field velocity = 0;          ///< w_t at time 0, plates only; 0 where values are prescribed
  double damping = 0;          ///< >= 0, plates only
  Field density = 1;
};

struct MarchResult {
  int steps = 0;
  int cycles = 0;                  ///< V-cycles of all steps
  std::vector<std::string> notes;  ///< what the user should know, one line each
};

/// Steps through the motion, implicitly, and hands each state to `frame`, that of time 0 first. Loads, side values and
/// supports do not change with time.
///
/// Heat: two stages of the method of order 2 that is L-stable, stiffly accurate and needs one operator only
/// [Alexander 1977]; for these linear problems the same as TR-BDF2. Plates: the trapezoidal rule, that is Newmark's
/// method with β = 1/4; each step keeps the balance of energy to rounding, so that undamped motion neither gains nor
/// loses any; what changes within a step rings on, such as initial values that do not fit the supports.
/// options.limits.accuracy is asked of each stage, in the energy norm and relative to the state.
///
/// Throws InvalidInput unless 0 < step, 0 < end, damping >= 0, density > 0 and initial values are finite, and where a
/// Poisson problem is given a velocity or damping; else as solve_boundary_problem does, but for loads that nothing
/// balances.
MarchResult march(const BoundaryProblem& problem, const Motion& motion,
                  const std::function<void(double time, const Solution& state)>& frame,
                  const BoundarySolveOptions& options = {});

}  // namespace batten
