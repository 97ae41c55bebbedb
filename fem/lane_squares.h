// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/curve_lanes.h>

#include <cstring>

namespace batten {

// Lines of numbers to steps of lanes and back, in squares of four lanes by four steps that are transposed in registers,
// so that whole vectors are loaded and stored. All is inlined: into kernels where it hides behind their chains of
// dependent operations, and compiled for the instructions that they are compiled for.

constexpr int lane_square = 4;
using LaneSquareRow [[gnu::vector_size(lane_square * sizeof(double))]] = double;

[[gnu::always_inline]] inline LaneSquareRow square_row_at(const double* numbers) {
  LaneSquareRow row;
  std::memcpy(&row, numbers, sizeof row);
  return row;
}
[[gnu::always_inline]] inline void store_row(LaneSquareRow row, double* numbers) {
  std::memcpy(numbers, &row, sizeof row);
}

struct LaneSquare {
  LaneSquareRow rows[lane_square];
};
[[gnu::always_inline]] inline LaneSquare transposed(const LaneSquare& s) {
  const LaneSquareRow a = __builtin_shufflevector(s.rows[0], s.rows[1], 0, 4, 2, 6);
  const LaneSquareRow b = __builtin_shufflevector(s.rows[0], s.rows[1], 1, 5, 3, 7);
  const LaneSquareRow c = __builtin_shufflevector(s.rows[2], s.rows[3], 0, 4, 2, 6);
  const LaneSquareRow d = __builtin_shufflevector(s.rows[2], s.rows[3], 1, 5, 3, 7);
  return {{__builtin_shufflevector(a, c, 0, 1, 4, 5), __builtin_shufflevector(b, d, 0, 1, 4, 5),
           __builtin_shufflevector(a, c, 2, 3, 6, 7), __builtin_shufflevector(b, d, 2, 3, 6, 7)}};
}

/// How far ahead of them the memory is asked: processors foresee few of so many lines that are read at once.
constexpr int lane_foresight = 64;

/// steps[k] of lane l = lines[l][from + k], 0 <= k < 8.
[[gnu::always_inline]] inline void gather_chunk(const double* const* lines, int from, LaneStep* steps) {
  for (int l = 0; l < lane_count; ++l) __builtin_prefetch(lines[l] + from + lane_foresight);
  for (int k = 0; k < lane_chunk; k += lane_square)
    for (int l = 0; l < lane_count; l += lane_square) {
      LaneSquare s;
      for (int i = 0; i < lane_square; ++i) s.rows[i] = square_row_at(lines[l + i] + from + k);
      s = transposed(s);
      for (int i = 0; i < lane_square; ++i) store_row(s.rows[i], reinterpret_cast<double*>(steps + k + i) + l);
    }
}

/// steps[k] of lane l = (lines[l][from + k + 1] - lines[l][from + k]) scale, 0 <= k < 8.
[[gnu::always_inline]] inline void gather_difference_chunk(const double* const* lines, int from, double scale,
                                                           LaneStep* steps) {
  for (int l = 0; l < lane_count; ++l) __builtin_prefetch(lines[l] + from + lane_foresight);
  for (int k = 0; k < lane_chunk; k += lane_square)
    for (int l = 0; l < lane_count; l += lane_square) {
      LaneSquare s;
      for (int i = 0; i < lane_square; ++i) {
        const double* const line = lines[l + i] + from + k;
        s.rows[i] = (square_row_at(line + 1) - square_row_at(line)) * scale;
      }
      s = transposed(s);
      for (int i = 0; i < lane_square; ++i) store_row(s.rows[i], reinterpret_cast<double*>(steps + k + i) + l);
    }
}

/// lines[l][from + k] = steps[k] of lane l, 0 <= k < 8. What is written in future is this far from it.
[[gnu::always_inline]] inline void scatter_chunk(const LaneStep* steps, double* const* lines, int from, int future) {
  for (int l = 0; l < lane_count; ++l) __builtin_prefetch(lines[l] + from + future, 1);
  for (int k = 0; k < lane_chunk; k += lane_square)
    for (int l = 0; l < lane_count; l += lane_square) {
      LaneSquare s;
      for (int i = 0; i < lane_square; ++i)
        s.rows[i] = square_row_at(reinterpret_cast<const double*>(steps + k + i) + l);
      s = transposed(s);
      for (int i = 0; i < lane_square; ++i) store_row(s.rows[i], lines[l + i] + from + k);
    }
}

}  // namespace batten
