// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/fit_problem.h>

#include <vector>

namespace batten {

/// Standard error of p at the corners of the cells, x fastest, in the scale of the data, for a problem whose λ and
/// weights are set:
///
///   s(x)² = σ² Σ_i l_i(x)² / w_i,   σ² = Σ w_i (z_i - p(x_i))² / (N - tr H),
///
/// with l(x) the weights with which p(x) depends on the data. Exact (a solve for each point) up to 5000 points, with 64
/// probes of random signs beyond. Throws InvalidInput where the fit leaves no degree of freedom for σ.
std::vector<double> standard_error(const FitProblem& problem, std::span<const double> coefficients, double degrees,
                                   const FitOptions& options);

/// Up to this number of points traces and standard errors are exact.
constexpr std::size_t most_exact_points = 5000;

}  // namespace batten
