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
/// of a group, one for each lane, are worked on together.
class LaneBlocks {
public:
  LaneBlocks(int rows, int shortest, int longest) : rows_(rows) {
    const int length = std::clamp((rows + lane_count - 1) / lane_count, shortest, longest);
    count_ = std::max(1, rows / length);
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

constexpr int lane_tile = 64;  // steps of all lanes that stay in the first cache

/// steps[k] of lane l = the number that read(l, starts[l] + k, n, out) puts at out[0], ..., of n numbers that follow
/// each other in a block, 0 <= k < count.
template <class Read>
void gather_lanes(const int* starts, int count, LaneSteps& steps, const Read& read) {
  double line[lane_tile];
  for (int tile = 0; tile < count; tile += lane_tile)
    for (int l = 0; l < lane_count; ++l) {
      const int n = std::min(lane_tile, count - tile);
      read(l, starts[l] + tile, n, line);
      for (int k = 0; k < n; ++k) steps[static_cast<std::size_t>(tile + k)].value[l] = line[k];
    }
}

/// out[starts[l] + k] = steps[from + k] of lane l, 0 <= k < lengths[l].
inline void scatter_lanes(const int* starts, const int* lengths, int from, const LaneSteps& steps, double* out) {
  const int count = static_cast<int>(steps.size()) - from;
  for (int tile = 0; tile < count; tile += lane_tile)
    for (int l = 0; l < lane_count; ++l)
      for (int k = tile; k < std::min(lengths[l], tile + lane_tile); ++k)
        out[starts[l] + k] = steps[static_cast<std::size_t>(from + k)].value[l];
}

}  // namespace batten
