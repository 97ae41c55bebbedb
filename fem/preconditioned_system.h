// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/conjugate_gradients.h>

namespace batten {

/// A symmetric positive semidefinite A with a preconditioner B of the same kind, for conjugate gradients that know no
/// more of it.
class PreconditionedSystem {
public:
  virtual ~PreconditionedSystem() = default;
  /// out = A c. Returns c · A c.
  virtual double apply(std::span<const double> c, std::span<double> out) const = 0;
  /// out = B r
  virtual void precondition(std::span<const double> r, std::vector<double>& out) const = 0;
};

/// Solves A c = b, b in the range of A, as `solve` does for a Multigrid; `scale` 0: sqrt(b·Bb).
IterationResult solve_system(const PreconditionedSystem& system, std::span<const double> b, std::span<double> c,
                             const IterationLimits& limits, double scale);

}  // namespace batten
