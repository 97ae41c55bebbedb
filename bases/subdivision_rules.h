// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/scheme.h>

#include <cstddef>
#include <vector>

namespace batten {

/// What lies beyond the ends of data.
enum class Ends {
  Zero,      ///< nothing, so that sums of scaling functions come out whole
  Periodic,  ///< the data again: closed polygons
  Open,      ///< unknown points, so that only those new points exist whose rules use old ones: open polygons
  Reflect,   ///< the data mirrored at their first and their last point, for masks symmetric about 0: limits have no
             ///< slope across the ends [Warren & Weimer 2001, sec. 6.4.2]
};

/// Where the old point i is found among n that are numbered 0 .. n - 1; -1 where there is none.
std::ptrdiff_t place_of(std::ptrdiff_t i, std::ptrdiff_t n, Ends ends);

/// Whether the mask is symmetric about 0 on an axis, as Ends::Reflect needs it.
template <int D>
bool is_even(const LaurentPolynomial<double, D>& mask, std::size_t axis);

/// Throws InvalidInput, which begins with `function`, when the ends ask for a symmetry that the mask lacks on an axis.
template <int D>
void require_ends(const char* function, const LaurentPolynomial<double, D>& mask, std::size_t axis, Ends ends);

/// Indices begin .. end - 1.
struct IndexRange {
  std::ptrdiff_t begin = 0;
  std::ptrdiff_t end = 0;
  std::ptrdiff_t size() const { return end - begin; }
};

/// The rules of one step along one axis. New points come in groups of `arity`: group g holds the new points arity g +
/// r, r = 0 .. arity - 1, all of them combinations of the old points g - reach .. g - reach + width - 1.
struct AxisRules {
  int arity = 2;
  int reach = 0;
  int width = 0;
  IndexRange exponents;                    ///< of the mask
  std::array<int, 3> lowest{}, highest{};  ///< exponents with a coefficient, by residue; highest < lowest where none

  IndexRange groups_of(const IndexRange& fine) const;
  /// The old points that groups use.
  IndexRange window_of(const IndexRange& groups) const;
  /// The new points that `old` ones have, by what lies beyond their ends. May be empty for open ends.
  IndexRange refined(const IndexRange& old, Ends ends) const;
};

/// Along axis 0 or 1 of a mask.
template <int D>
AxisRules axis_rules(const LaurentPolynomial<double, D>& mask, std::size_t axis, int arity);

/// The weights of a group along x: weights[q + width r] is the weight of old point g - reach + q in new point arity g +
/// r. In two dimensions there is one such set for each residue and each old row in y, at [row + width_y residue_y].
std::vector<std::vector<double>> group_weights(const Mask<double>& mask, const AxisRules& x);
std::vector<std::vector<double>> group_weights(const Mask2<double>& mask, const AxisRules& x, const AxisRules& y);

/// out[arity g + r] = Σ_q weights[q + width r] in[g + q] for g = 0 .. groups - 1; arity 2 or 3. Fills the caller's
/// memory, arity * groups numbers, from groups + width - 1; in and out do not overlap.
void refine_groups_into(const AxisRules& rules, const double* weights, const double* in, std::ptrdiff_t groups,
                        double* out);

}  // namespace batten
