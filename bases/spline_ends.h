// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/banded_rows.h>

namespace batten {

/// What all functions of a spline basis keep at one end of the interval.
enum class EndCondition {
  Free,     ///< nothing
  Zero,     ///< u = 0
  Flat,     ///< u' = 0
  Clamped,  ///< u = u' = 0
};

/// A subspace of the splines on an interval. Its functions keep the numbers of the whole basis; those that the
/// condition takes away become the zero function:
///
///   Zero      N_0 <- 0
///   Flat      N_0 <- 0, N_1 <- N_0 + N_1
///   Clamped   N_0, N_1 <- 0
///
/// and likewise at the upper end. Subspaces of coarser intervals are nested in those of finer ones.
struct EndConditions {
  EndCondition lower = EndCondition::Free, upper = EndCondition::Free;

  bool are_free() const { return lower == EndCondition::Free && upper == EndCondition::Free; }
  /// How many functions they take away.
  int removed() const { return removed_at(lower) + removed_at(upper); }
  static int removed_at(EndCondition c) { return c == EndCondition::Free ? 0 : c == EndCondition::Clamped ? 2 : 1; }
  bool operator==(const EndConditions&) const = default;
};

/// T^T, size x size: T holds the coefficients of the subspace's functions in the whole basis, of at least 3 functions.
BandedRows subspace_restriction(int size, const EndConditions& ends);

/// M T, where the columns of T hold the coefficients of the subspace's functions in the whole basis.
BandedRows with_constrained_columns(BandedRows matrix, const EndConditions& ends);
/// T^T M.
BandedRows with_constrained_rows(BandedRows matrix, const EndConditions& ends);
/// Rows of functions that the conditions take away set to zero: coefficients in the whole basis become those in the
/// subspace, for functions that are in it.
BandedRows without_removed_rows(BandedRows matrix, const EndConditions& ends);

}  // namespace batten
