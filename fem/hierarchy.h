// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/rectangle.h>
#include <batten/fem/energy.h>
#include <batten/fem/operator.h>

#include <optional>
#include <span>
#include <vector>

namespace batten {

/// Where the energy is measured: the longer side of the region (y multiplied by `aspect` first) has length 1.
struct Normalisation {
  double aspect = 1;  ///< one unit of y counts as this many units of x
};

/// The conditions that all splines of a space keep on the sides of the rectangle.
struct SpaceEnds {
  EndConditions x, y;  ///< left and right, bottom and top
};

/// The levels of a spline space on a rectangle and of an energy on it, the finest first.
///
/// The spaces are nested: refinement R_k (B-spline subdivision with exact rules at the boundary) maps the coefficients
/// of level k + 1 to those of level k, and E_{k+1} = R_k^T E_k R_k: to rounding where the coefficients of the energy
/// are constant, because both are exact, and by definition where they vary. A direction is halved while its cells are
/// not much longer than those of the other one, so that cells grow towards squares.
class Hierarchy {
public:
  struct Level {
    SplineSpace space;
    Operator energy;
    double bound;                          ///< largest eigenvalue of diag(E)^-1 E, from above
    std::optional<TensorSum> refinement;   ///< R: from the next coarser level to this one; none on the coarsest
    std::optional<TensorSum> restriction;  ///< R^T
  };

  /// Degree 1 to 5 and at least the order of every derivative, at least 2 cells each way, numbers of cells between
  /// periodic sides that can be halved until a direct solution is cheap; InvalidInput otherwise.
  Hierarchy(const Energy& energy, const Rectangle& region, int degree, const Normalisation& normalisation = {},
            const SpaceEnds& ends = {});
  /// Varying coefficients: E on the finest level is given, as a matrix on finest_space(...) of the same arguments.
  Hierarchy(SymmetricStencil energy, const Rectangle& region, int degree, const Normalisation& normalisation = {},
            const SpaceEnds& ends = {});

  /// Of constant coefficients only.
  const Energy& energy() const { return energy_.value(); }
  const Rectangle& region() const { return region_; }
  int degree() const { return levels_.front().space.x.degree(); }
  int size() const { return static_cast<int>(levels_.size()); }
  const Level& operator[](int k) const { return levels_[static_cast<std::size_t>(k)]; }
  const Level& finest() const { return levels_.front(); }
  /// coarse = R^T r from level k to the next coarser one.
  void restrict_from(int k, std::span<const double> r, std::span<double> coarse) const;

private:
  void build(SplineSpace space, Operator finest);

  std::optional<Energy> energy_;
  Rectangle region_;
  std::vector<Level> levels_;
};

/// The spline space of a hierarchy's finest level. Throws InvalidInput as Hierarchy does.
SplineSpace finest_space(const Rectangle& region, int degree, const Normalisation& normalisation = {},
                         const SpaceEnds& ends = {});

}  // namespace batten
