// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/constrained_fit.h>

#include <span>

namespace batten {

/// What a bounded fit starts from and stays close to.
struct BoundedFitTask {
  ConstrainedFit start;                ///< the solution without bounds, with its λ > 0 where there are no tolerances
  std::span<const double> tolerances;  ///< of the data in their own order and scale; empty: λ says
  bool interpolates = false;           ///< λ is that of interpolation: data are met, where they can be
};

/// The fit whose values stay within options.minimum and options.maximum everywhere.
///
/// B-splines are not negative and sum to 1, so values lie between the least and the largest coefficient. Those of the
/// same spline on a grid of 8 x 8 times as many cells differ from its values by a 64th of what those of the grid itself
/// do, about h² |∇²p| / 400 for cells of size h: they are bounded. Only the ones near a bound enter the problem; it is
/// solved again with more of them until all are within. Throws SolverError where that does not end.
ConstrainedFit fit_between(const FitData& data, const Rectangle& region, const FitOptions& options,
                           const BoundedFitTask& task);

}  // namespace batten
