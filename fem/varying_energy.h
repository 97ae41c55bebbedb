// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_problem.h>
#include <batten/fem/symmetric_stencil.h>

#include <string>
#include <vector>

namespace batten {

/// One part of an energy with varying coefficients, factor ∫∫ κ(x, y) (∂^left p) (∂^right p), in the units of the
/// problem.
struct VaryingTerm {
  struct Orders {
    int x = 0, y = 0;  ///< at most 2
  };
  Field coefficient;
  double factor = 1;
  Orders left, right;
  std::string name;         ///< of the coefficient, for messages
  bool may_vanish = false;  ///< κ >= 0 is asked; else κ > 0
};

/// The parts of a problem's energy: a(u, u) is their sum.
std::vector<VaryingTerm> energy_terms(const BoundaryProblem& problem);

/// E of Σ_t factor_t ∫∫ κ_t (...)(...) on all splines of a degree over the rectangle's cells, integrated once by
/// degree + 1 Gauss points in each cell and direction, with its row sums. Throws InvalidInput where a coefficient is
/// not finite or not positive at such a point, naming it.
SymmetricStencil varying_stencil(const std::vector<VaryingTerm>& terms, const Rectangle& region, int degree);

}  // namespace batten
