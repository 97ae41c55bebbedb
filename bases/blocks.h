// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <vector>

namespace batten {

/// Rows cut into fixed blocks. Which rows form a block depends on the size of the grid alone, never on the number of
/// threads, and partial sums are added in block order: every thread count gives the same bits.
class RowBlocks {
public:
  /// Blocks of about 16 000 values, at least `least` rows each.
  RowBlocks(int rows, int row_length, int least = 1)
      : rows_(rows), height_(std::clamp(16384 / std::max(row_length, 1), least, std::max(rows, least))) {}

  int count() const { return (rows_ + height_ - 1) / height_; }
  int begin(int block) const { return block * height_; }
  int end(int block) const { return std::min(rows_, (block + 1) * height_); }

private:
  int rows_, height_;
};

/// Calls work(first row, end row) for every block, on all threads.
template <std::invocable<int, int> Work>
void for_blocks(const RowBlocks& blocks, Work&& work) {
#pragma omp parallel for schedule(static) if (blocks.count() > 1)
  for (int block = 0; block < blocks.count(); ++block) work(blocks.begin(block), blocks.end(block));
}

/// Σ of work(first row, end row) over the blocks, in block order.
template <std::invocable<int, int> Work>
double sum_blocks(const RowBlocks& blocks, Work&& work) {
  std::vector<double> partial(static_cast<std::size_t>(blocks.count()));
#pragma omp parallel for schedule(static) if (blocks.count() > 1)
  for (int block = 0; block < blocks.count(); ++block)
    partial[static_cast<std::size_t>(block)] = work(blocks.begin(block), blocks.end(block));
  double sum = 0;
  for (double p : partial) sum += p;
  return sum;
}

/// Calls work for the even blocks, then for the odd ones: blocks may add into the `least` rows that follow them without
/// two threads meeting.
template <std::invocable<int, int> Work>
void for_alternating_blocks(const RowBlocks& blocks, Work&& work) {
  for (int colour : {0, 1}) {
#pragma omp parallel for schedule(static) if (blocks.count() > 3)
    for (int block = colour; block < blocks.count(); block += 2) work(blocks.begin(block), blocks.end(block));
  }
}

}  // namespace batten
