// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/constrained_fit.h>

namespace batten {

/// Whether a minimum or a maximum is asked for.
inline bool has_bounds(const FitOptions& options) { return options.minimum || options.maximum; }

/// The tolerance of observation i where those of Observations count in `unit`.
double tolerance_of(const Observations& observations, std::size_t i, double unit);

/// The surface that keeps the tolerances and bounds of the options. `free`: the one without bounds, where there are no
/// tolerances. Where a function without energy does, it is added to the null element of the data, and all coefficients
/// are 0.
ConstrainedFit fit_constrained(FitProblem& problem, FitData& data, const Observations& observations,
                               const FitOptions& options, ScaledFit free);

}  // namespace batten
