// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/banded_rows.h>
#include <batten/bases/grid_ranges.h>
#include <batten/bases/repeated_rows.h>
#include <batten/fem/hierarchy.h>

#include <algorithm>

namespace batten {

// Which rows and columns the blocks of a streamed pass take in.

/// Of several blocks of one direction.
struct BlockPlace {
  int index, count;
};

/// Part `place` of nearly equal ones of 0 .. size - 1.
template <typename Range>
Range part(int size, BlockPlace place) {
  const auto cut = [&](int k) { return static_cast<int>(static_cast<long long>(size) * k / place.count); };
  return {cut(place.index), cut(place.index + 1)};
}

/// The range and what the rows of `band` that belong to `result` take in.
template <typename Range>
Range with_inputs(Range range, const BandedRows& band, Range result) {
  if (result.begin >= result.end) return range;
  const auto first = [&](int i) { return band.first[static_cast<std::size_t>(i)]; };
  return {std::min(range.begin, first(result.begin)), std::max(range.end, first(result.end - 1) + band.width)};
}

template <typename Range>
Range widened(Range range, int by, int size) {
  return {std::max(0, range.begin - by), std::min(size, range.end + by)};
}

/// M^-1 of the level's smoothing polynomials, M = λ bound diag(E).
inline RepeatedRows inverse_diagonal(const Hierarchy::Level& level, double lambda) {
  RepeatedRows result = level.energy.diagonal_rows();
  for (double& v : result.values())  // functions that a condition takes away have the entry 0 and stay at 0
    v = v > 0 ? 1 / (lambda * level.bound * v) : 0;
  return result;
}

}  // namespace batten
