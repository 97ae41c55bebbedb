// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/fit.h>

#include <span>

namespace batten {

/// Throws InvalidInput if no surface at all can keep what is asked at the observations used: tolerances that are not
/// positive; a minimum not below the maximum; values at one place further apart than their tolerances; values farther
/// beyond a bound than their tolerance, or beyond it at all where they are to be met. Names the observations.
void check_contradictions(const Observations& observations, std::span<const std::size_t> used,
                          const FitOptions& options);

/// "observation 7", or what the options call it.
std::string name_of(const FitOptions& options, std::size_t observation);

}  // namespace batten
