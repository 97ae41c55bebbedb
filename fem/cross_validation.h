// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/fit_problem.h>

#include <vector>

namespace batten {

/// Range in which λ is searched.
constexpr double smallest_lambda = 1e-14, largest_lambda = 1e2;

struct CrossValidationResult {
  double lambda = 0;
  double effective_degrees = 0;  ///< trace of the influence matrix at lambda, estimated
  bool interior = true;          ///< false if the minimum is at the lower end of the range
  double work = 0;               ///< V-cycles spent, in units of a V-cycle of the last grid, and of these ...
  double refinement_work = 0;    ///< ... on the last grid after a search on a coarser one
  std::vector<double> start;     ///< coefficients close to the solution, if the search ran on the last grid
};

/// λ that minimises the generalised cross-validation score [Craven & Wahba 1979]
///
///   V(λ) = Σ w_i (z_i - p(x_i))² / (1 - tr H / N)²,   H the influence matrix, z -> p,
///
/// with the trace estimated by probes of random signs [Hutchinson 1990] that stay the same for all λ and grids. The
/// search runs on a grid with at least 2 sqrt(N) cells on each side, if the last one is finer; a parabola through three
/// scores on the last grid refines it.
CrossValidationResult cross_validate(PenalisedProblem& problem, const FitOptions& options);

}  // namespace batten
