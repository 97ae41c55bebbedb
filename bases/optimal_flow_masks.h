// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/flow_masks.h>

namespace batten {

/// Finite masks and the flow_norm() of the residuals that they leave.
struct OptimalFlowMasks {
  FlowMasks<Rational> masks;
  Rational divergence, rotation;
};

/// The masks within |exponent| <= size / 2, so that s11 has size x (size + 1) coefficients at most, that keep constant
/// fields and for which the sum of the flow_norm() of the two residuals is least, exact, by linear programming
/// [Warren & Weimer 2001, sec. 5.3.4]. The commuting kind obeys its law of divergence exactly; the book's kind obeys
/// the law of rotation exactly for perfect flow, while for slow flow no finite masks can, and both residuals are made
/// small.
///
/// Throws InvalidInput unless size is odd and >= 3; SolverError as for optimum().
OptimalFlowMasks optimal_flow_masks(Flow flow, FlowKind kind, int size);

}  // namespace batten
