// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/fit_problem.h>

namespace batten {

/// The λ of the augmented Lagrangian: small, so that few outer steps are needed; the solver does not mind.
constexpr double interpolation_lambda = 1e-14;

/// Least energy with p(x_i) = z_i, by the method of multipliers: solves with that λ for data that are moved by the
/// residuals so far, until the largest residual is below 1e-10 of the data's range or stops falling.
ScaledFit interpolate(PenalisedProblem& problem, const FitOptions& options);

}  // namespace batten
