// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/grid_ranges.h>

#include <algorithm>
#include <bit>
#include <concepts>

namespace batten {

/// Several stages of work on the rows of a grid in one pass over memory. Stage s at row j uses what stage s - 1 left at
/// rows j - reach .. j + reach; it follows `reach` rows behind that stage, so that the rows in between stay in the
/// cache. What stage s - 1 has read may be overwritten by stage s + 1: two buffers in turn hold all stages.
///
/// The rows are cut into fixed blocks, shared by the threads. Where two blocks meet, each stage of a block ends `reach`
/// rows earlier than the one before and begins as much later; the rows left out around the cuts follow afterwards.
/// Nothing is done twice, and a row's numbers depend neither on the cuts nor on the threads.
class Wavefront {
public:
  Wavefront(int rows, int stages, int reach)
      : rows_(rows),
        stages_(stages),
        reach_(reach),
        blocks_(static_cast<int>(std::bit_floor(
            static_cast<unsigned>(std::clamp(rows / std::max(1, 4 * reach * stages), 1, most_blocks))))) {}

  /// Calls work(stage, row, range) on all threads: `range` holds the rows of this stage that the same thread does one
  /// after another, upwards.
  template <std::invocable<int, int, RowRange> Work>
  void run(Work&& work) const {
#pragma omp parallel if (blocks_ > 1)
    {
#pragma omp for schedule(static)
      for (int block = 0; block < blocks_; ++block)
        sweep({cut(block), cut(block + 1), block > 0 ? reach_ : 0, block + 1 < blocks_ ? -reach_ : 0}, work);
#pragma omp for schedule(static)
      for (int block = 1; block < blocks_; ++block) sweep({cut(block), cut(block), -reach_, reach_}, work);
    }
  }

private:
  /// Rows of stage 0, and by how many rows both ends move from stage to stage.
  struct Tile {
    int begin, end, move_begin, move_end;
    RowRange at(int stage) const { return {begin + stage * move_begin, end + stage * move_end}; }
  };

  static constexpr int most_blocks = 32;

  int cut(int block) const { return static_cast<int>(static_cast<long long>(rows_) * block / blocks_); }

  template <typename Work>
  void sweep(const Tile& tile, Work& work) const {
    const int last = stages_ - 1;
    for (int front = tile.begin; front < tile.at(last).end + last * reach_; ++front)
      for (int stage = 0; stage < stages_; ++stage) {
        const RowRange range = tile.at(stage);
        const int row = front - stage * reach_;
        if (row >= range.begin && row < range.end) work(stage, row, range);
      }
  }

  int rows_, stages_, reach_, blocks_;
};

}  // namespace batten
