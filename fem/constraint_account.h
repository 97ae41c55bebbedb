// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

namespace batten {

/// What a solution under constraints is worth.
struct ConstraintAccount {
  /// (energy - bound) / max(energy, 1e-8 range²) in the normalised problem, the bound proved by forces of its own: no
  /// admissible solution has less.
  double energy_gap = 0;
  double largest_violation = 0;           ///< distance beyond a bound, over the tolerance; 0 where all are met
  std::optional<double> least_tolerance;  ///< the least that can be met, where the one asked for cannot
  std::size_t active = 0;                 ///< constraints that hold the solution: at their bound, with a force
  int cycles = 0;                         ///< V-cycles of the last grid, work on others in proportion
};

}  // namespace batten
