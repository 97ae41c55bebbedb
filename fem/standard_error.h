// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/fit_problem.h>

#include <vector>

namespace batten {

/// What the data leave uncertain of a fit whose λ and weights are set.
struct Uncertainty {
  double effective_degrees = 0;        ///< tr H, H the influence matrix that maps the data to the fit
  std::vector<double> standard_error;  ///< of p at the corners of the cells, x fastest, in the scale of the data
};

/// Up to this number of points the uncertainty is exact, beyond it is estimated by probes.
constexpr std::size_t most_exact_points = 5000;

///   s(x)² = σ² Σ_i l_i(x)² / w_i,   σ² = Σ w_i (z_i - p(x_i))² / (N - tr H),
///
/// with l(x) the weights with which p(x) depends on the data. A solve for each point, or for each of 64 probes of
/// random signs [Hutchinson 1990] where there are more than `exact_up_to` points. Throws InvalidInput where the fit
/// leaves no degree of freedom for σ.
Uncertainty uncertainty(const FitProblem& problem, std::span<const double> coefficients, const FitOptions& options,
                        std::size_t exact_up_to = most_exact_points);

}  // namespace batten
