// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/rectangle.h>
#include <batten/fem/energy.h>
#include <batten/fem/operator.h>

#include <optional>
#include <vector>

namespace batten {

/// Where the energy is measured: the longer side of the region (y multiplied by `aspect` first) has length 1.
struct Normalisation {
  double aspect = 1;  ///< one unit of y counts as this many units of x
};

/// The levels of a spline space on a rectangle and of an energy on it, the finest first.
///
/// The spaces are nested: refinement R_k (B-spline subdivision with exact rules at the boundary) maps the coefficients
/// of level k + 1 to those of level k, and E_{k+1} = R_k^T E_k R_k holds to rounding because both are exact. A
/// direction is halved while its cells are not much longer than those of the other one, so that cells grow towards
/// squares.
class Hierarchy {
public:
  struct Level {
    SplineSpace space;
    Operator energy;
    double bound;                          ///< largest eigenvalue of diag(E)^-1 E, from above
    std::optional<TensorSum> refinement;   ///< R: from the next coarser level to this one; none on the coarsest
    std::optional<TensorSum> restriction;  ///< R^T
  };

  /// Degree 2 or 3, at least 2 cells each way; InvalidInput otherwise.
  Hierarchy(const Energy& energy, const Rectangle& region, int degree, const Normalisation& normalisation = {});

  const Energy& energy() const { return energy_; }
  const Rectangle& region() const { return region_; }
  int degree() const { return levels_.front().space.x.degree(); }
  int size() const { return static_cast<int>(levels_.size()); }
  const Level& operator[](int k) const { return levels_[static_cast<std::size_t>(k)]; }
  const Level& finest() const { return levels_.front(); }

private:
  Energy energy_;
  Rectangle region_;
  std::vector<Level> levels_;
};

}  // namespace batten
