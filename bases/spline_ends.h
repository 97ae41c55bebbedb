// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/banded_rows.h>
#include <batten/bases/rational.h>

#include <vector>

namespace batten {

/// What all functions of a spline basis keep at one end of the interval.
enum class EndCondition {
  Free,     ///< nothing
  Zero,     ///< u = 0
  Flat,     ///< u' = 0
  Clamped,  ///< u = u' = 0
  Periodic  ///< at both ends: the interval closes to a circle
};

/// A subspace of the splines on an interval. Its functions keep the numbers of the whole basis; those that the
/// condition takes away become the zero function:
///
///   Zero      N_0 <- 0
///   Flat      N_0 <- 0, N_1 <- N_0 + N_1
///   Clamped   N_0, N_1 <- 0
///
/// and likewise at the upper end. Subspaces of coarser intervals are nested in those of finer ones.
///
/// A periodic basis is that of the uniform B-splines, restricted to the interval. As many of them as the degree says
/// reach beyond each end: the last ones are images of the first. The coefficients of a periodic spline repeat there,
/// and what is integrated with an image belongs to its original; matrices hold the integrals image by image.
struct EndConditions {
  EndCondition lower = EndCondition::Free, upper = EndCondition::Free;

  bool are_free() const { return lower == EndCondition::Free && upper == EndCondition::Free; }
  bool is_periodic() const { return lower == EndCondition::Periodic; }
  /// How many functions a condition takes away.
  static int removed_at(EndCondition c) {
    if (c == EndCondition::Free || c == EndCondition::Periodic) return 0;
    return c == EndCondition::Clamped ? 2 : 1;
  }
  bool operator==(const EndConditions&) const = default;
};

/// T^T, size x size: T holds the coefficients of the subspace's functions in the whole basis, of at least 3 functions.
BandedRows subspace_restriction(int size, int degree, const EndConditions& ends);

/// Coefficients of the periodic basis in the whole one at the lower end: N_j has the coefficient Σ_k a[j][k] c_k, for
/// j, k < degree. The upper end is its mirror image. By knot insertion [Boehm 1980], exact.
std::vector<std::vector<Rational>> periodic_end(int degree);
/// R of a periodic basis on `cells` cells to that on twice as many: (2 cells + degree) x (cells + degree).
BandedRows periodic_refinement(int cells, int degree);

// For conditions that are not periodic:

/// M T, where the columns of T hold the coefficients of the subspace's functions in the whole basis.
BandedRows with_constrained_columns(BandedRows matrix, const EndConditions& ends);
/// T^T M.
BandedRows with_constrained_rows(BandedRows matrix, const EndConditions& ends);
/// Rows of functions that the conditions take away set to zero: coefficients in the whole basis become those in the
/// subspace, for functions that are in it.
BandedRows without_removed_rows(BandedRows matrix, const EndConditions& ends);

}  // namespace batten
