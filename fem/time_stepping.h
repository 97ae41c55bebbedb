// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_solver.h>

#include <functional>

namespace batten {

/// Motion in time: for Poisson problems density u_t + A u = f (heat), for plates density w_tt + damping w_t + A w = q.
struct Motion {
  double end = 1, step = 0.1;  ///< the last step is shortened to end at `end`
  Field initial = 0;           ///< u at time 0, L2-projected
  Field velocity = 0;          ///< w_t at time 0, plates only
  double damping = 0;          ///< >= 0, plates only
  Field density = 1;
};

/// Steps through the motion, implicitly (heat: L-stable, second order; plates: the trapezoidal rule, which keeps the
/// energy of undamped motion), and hands each state to `frame`, that of time 0 first. Loads and side values do not
/// change with time. Throws InvalidInput unless 0 < step, 0 < end and damping >= 0.
void march(const BoundaryProblem& problem, const Motion& motion,
           const std::function<void(double time, const Solution& state)>& frame,
           const BoundarySolveOptions& options = {});

}  // namespace batten
