// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/fit_problem.h>

#include <span>

namespace batten {

/// The λ of the augmented Lagrangian: small, so that few outer steps are needed; the solver does not mind.
constexpr double interpolation_lambda = 1e-14;

/// Least energy with p(x_i) = z_i, by the method of multipliers: solves with that λ for data that are moved by the
/// residuals so far, until the largest residual is below 1e-10 of the data's range or stops falling.
ScaledFit interpolate(PenalisedProblem& problem, const FitOptions& options);

/// Least energy with |p(x_i) - z_i| <= tolerances_i (in the scale of the data, in the order of problem.points())
/// [Kersey 2003], by the method of multipliers
/// for the box of values of each point; each of its problems is solved by active sets: points inside their box are
/// free.
ScaledFit interpolate_within(PenalisedProblem& problem, std::span<const double> tolerances, const FitOptions& options);

}  // namespace batten
