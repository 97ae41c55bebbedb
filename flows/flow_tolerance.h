// SPDX-License-Identifier: MIT
#pragma once

#include <batten/flows/flow_data.h>

namespace batten {

// What Smoothing::within asks of a flow, in the norm of the options.

/// Throws InvalidInput for vectors at one place that no velocity is within the tolerance of, naming both.
void check_contradictions(const VectorObservations& observations, const FlowData& data, const FlowOptions& options);

/// The field of least energy within the tolerance, and what is known of it in result.constraints. Where one without
/// energy is, it is added to the null element of the data and the coefficients are 0.
ScaledFit fit_flow_within(PenalisedProblem& problem, FlowData& data, const FlowOptions& flow, const FitOptions& options,
                          FlowResult& result);

/// Whether all observations that were fitted are within the tolerance.
void judge_tolerance(const VectorObservations& observations, const FlowOptions& options, FlowResult& result);

}  // namespace batten
