// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/constraint_account.h>
#include <batten/fem/fit_problem.h>

#include <optional>
#include <span>
#include <vector>

namespace batten {

/// Where the measurements of a problem may lie, and which of them pull; all in the scale of its data and the order of
/// its grid.
struct MeasurementLimits {
  std::vector<double> lower, upper;  ///< infinite where there is none
  std::vector<double> unit;          ///< positive: tolerances, or what violations of other limits are measured in
  std::vector<bool> gives;   ///< a tolerance, which the least one that can be met replaces where it is too small
  std::vector<double> pull;  ///< weights of (value_i - (B c)_i)² / 2 beside the energy; none where empty
  double rise = 1;           ///< how many times the energy of the start the least one may be: more costs steps
};

struct ConstrainedFit : ScaledFit {
  ConstraintAccount account;
  std::optional<double> growth;  ///< the tolerances that can be met over those asked, where these cannot
};

/// Least ½ c·E c + pulls within the limits, from a start. Where the limits cannot be met: the least growth of the
/// tolerances, and what is nearly of least energy within those.
ConstrainedFit fit_within(PenalisedProblem& problem, const MeasurementLimits& limits, std::vector<double> start,
                          const FitOptions& options);

/// Least energy with |v_k - value_k| <= radius for the vectors v_k = (rows 2k, 2k + 1 of B c over their factors).
ConstrainedFit fit_within_balls(PenalisedProblem& problem, double radius, const std::vector<double>& factors,
                                const FitOptions& options);

/// Least energy with |p(x_i) - z_i| <= tolerances_i (in the scale of the data, in the order of the grid).
ConstrainedFit fit_within(PenalisedProblem& problem, std::span<const double> tolerances, const FitOptions& options);

}  // namespace batten
