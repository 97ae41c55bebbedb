// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/multigrid.h>

namespace batten {

/// Bytes that must travel between memory and processor for one V-cycle of a system that is not data-aware, every read
/// and every write of a number counted once, as the triad counts them; the work of a smoothing step is taken to be one
/// pass over the vectors.
double cycle_traffic(const Multigrid& system);

/// ... for one iteration of preconditioned conjugate gradients: a V-cycle and what is around it.
double iteration_traffic(const Multigrid& system);

/// ... for a whole `solve` from zero: the iterations and, for start and end, two V-cycles and one residual.
double solve_traffic(const Multigrid& system, int iterations);

}  // namespace batten
