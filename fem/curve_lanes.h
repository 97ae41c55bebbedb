// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace batten {

// Blocks of a curve that are advanced together, one in each lane of a vector, so that the chain of dependent operations
// of one hides behind those of the others. Kernels alone see these types.

constexpr int lane_count = 8;
using Lanes [[gnu::vector_size(lane_count * sizeof(double))]] = double;

/// What a step of each lane needs or leaves; the steps of a group of blocks.
struct alignas(lane_count * sizeof(double)) LaneStep {
  Lanes value;
};
using LaneSteps = std::vector<LaneStep>;

/// `rows` points cut into blocks whose lengths differ by at most one; how depends on the number of points alone. Blocks
/// of a group, one for each lane, are worked on together: where there are several groups all of their lanes have one.
class LaneBlocks {
public:
  LaneBlocks(int rows, int shortest, int longest) : rows_(rows) {
    const int groups = (rows + lane_count * longest - 1) / (lane_count * longest);
    count_ = groups > 1 ? groups * lane_count : std::clamp(rows / shortest, 1, lane_count);
  }

  int count() const { return count_; }
  int groups() const { return (count_ + lane_count - 1) / lane_count; }
  /// Of a block; those beyond the last are empty.
  int begin(int block) const {
    return static_cast<int>(static_cast<std::ptrdiff_t>(std::min(block, count_)) * rows_ / count_);
  }
  int length(int block) const { return begin(block + 1) - begin(block); }
  int longest() const { return (rows_ + count_ - 1) / count_; }

private:
  int rows_, count_;
};

constexpr int lane_chunk = 8;  // steps that are read or written at once, a cache line of each lane
constexpr int lane_tile = 64;  // steps of all lanes that stay in the first cache

// Of up to a tile:

/// steps[k] of lane l = lines[l][k], 0 <= k < count.
void gather_lanes(const double* const* lines, int count, LaneStep* steps);
/// steps[k] of lane l = (lines[l][k + 1] - lines[l][k]) scale, 0 <= k < count.
void gather_differences(const double* const* lines, int count, double scale, LaneStep* steps);
/// lines[l][k] = steps[k] of lane l, 0 <= k < count.
void scatter_lanes(const LaneStep* steps, int count, double* const* lines);

/// steps[k] of lane l = the number of place starts[l] + k in a line, 0 <= k < count. read(l, place, n, buffer) says
/// where n numbers that follow each other in the line of a lane are: there, or in the buffer that it has filled.
template <class Read>
void gather_lanes(const int* starts, int count, LaneStep* steps, const Read& read) {
  double buffers[lane_count][lane_tile];
  const double* lines[lane_count];
  for (int tile = 0; tile < count; tile += lane_tile) {
    const int n = std::min(lane_tile, count - tile);
    for (int l = 0; l < lane_count; ++l) lines[l] = read(l, starts[l] + tile, n, buffers[l]);
    gather_lanes(lines, n, steps + tile);
  }
}

/// steps[k] of lane l = width(l, cell), cell = starts[l] + k, 0 <= k < count; which is (knots[cell + 1] - knots[cell])
/// scale where 0 <= cell < ends[l].
template <class Width>
void gather_widths(const double* knots, double scale, const int* starts, const int* ends, int count, LaneStep* steps,
                   const Width& width) {
  const double* lines[lane_count];
  for (int tile = 0; tile < count; tile += lane_tile) {
    const int n = std::min(lane_tile, count - tile);
    int inside = n;
    for (int l = 0; l < lane_count; ++l) {
      const int cell = starts[l] + tile;
      inside = cell < 0 ? 0 : std::clamp(ends[l] - cell, 0, inside);
      lines[l] = knots + cell;
    }
    gather_differences(lines, inside, scale, steps + tile);
    for (int k = tile + inside; k < tile + n; ++k)
      for (int l = 0; l < lane_count; ++l) steps[k].value[l] = width(l, starts[l] + k);
  }
}

/// out[starts[l] + k] = steps[from + k] of lane l, 0 <= k < lengths[l].
inline void scatter_lanes(const int* starts, const int* lengths, int from, const LaneSteps& steps, double* out) {
  const int shared = *std::min_element(lengths, lengths + lane_count);
  double* lines[lane_count];
  for (int tile = 0; tile < shared; tile += lane_tile) {
    for (int l = 0; l < lane_count; ++l) lines[l] = out + starts[l] + tile;
    scatter_lanes(&steps[static_cast<std::size_t>(from + tile)], std::min(lane_tile, shared - tile), lines);
  }
  for (int l = 0; l < lane_count; ++l)
    for (int k = shared; k < lengths[l]; ++k) out[starts[l] + k] = steps[static_cast<std::size_t>(from + k)].value[l];
}

}  // namespace batten
