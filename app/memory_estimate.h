// SPDX-License-Identifier: MIT
#pragma once

namespace batten {

/// What a fit is asked to hold. The numbers are doubles so that no absurd size overflows them.
struct FitSize {
  double cells_x = 0, cells_y = 0;
  int degree = 3;
  double points = 0;
  bool interpolates = false;  ///< no smoothing, or a tolerance
  int splines = 1;            ///< 2: a sum, as of a rotation and a gradient
};

/// Bytes that a fit of this size needs at its peak, measured; an estimate, not a bound.
double fit_memory(const FitSize& size);

/// Bytes that this process may still take: the machine's free memory or the limit of the control group or process,
/// whichever is smallest. Infinity if nothing is known.
double available_memory();

/// Throws InvalidInput, with both numbers, if `fit_memory` exceeds `available_memory`.
void check_memory(const FitSize& size);

/// What the solution of a boundary value problem is asked to hold.
struct SolveSize {
  double cells_x = 0, cells_y = 0;
  int degree = 3;
  bool varies = false;  ///< a coefficient of the material is not constant, so that stencils are stored
};

/// Bytes that such a problem needs at its peak, with what is written, measured; an estimate, not a bound.
double solve_memory(const SolveSize& size);

/// As above for `solve_memory`.
void check_memory(const SolveSize& size);

}  // namespace batten
