// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask_family.h>
#include <batten/bases/polyharmonic_residual.h>

namespace batten {

// Finite masks in place of the polyharmonic one of an order, see polyharmonic_scheme.h. Both functions throw
// InvalidInput when the order is below 1, the size even or below 3, and name the first constraint that cannot be met.

/// A mask and the largest coset sum of its residual, with the dual certificate checked: no mask of the family has less.
struct OptimalMask {
  Mask2<Rational> mask;
  Rational residual;
};

/// The mask whose residual_norm is least under the constraints, exact, by linear programming
/// [Warren & Weimer 2001, sec. 5.2.3]. SolverError as for optimum().
OptimalMask optimal_mask(int order, int size, const MaskConstraints& constraints = {});

/// The mask for which the sum of the squares of all coefficients of the residual is least, exact.
Mask2<Rational> least_squares_mask(int order, int size, const MaskConstraints& constraints = {});

}  // namespace batten
