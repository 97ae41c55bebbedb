// SPDX-License-Identifier: MIT
#include <batten/bases/wavefront.h>

#include <gtest/gtest.h>
#include <omp.h>

#include <array>
#include <vector>

namespace batten {
namespace {

/// Stages of v_j <- v_{j-reach} + 3 v_j + 5 v_{j+reach} modulo 2^64 in two buffers; the rows of a range must come one
/// after another.
std::vector<unsigned long> smoothed(int rows, int stages, int reach, bool one_by_one) {
  std::array<std::vector<unsigned long>, 2> v{std::vector<unsigned long>(static_cast<std::size_t>(rows)),
                                              std::vector<unsigned long>(static_cast<std::size_t>(rows))};
  std::vector<int> done(static_cast<std::size_t>(rows * stages));
  const auto work = [&](int stage, int j, RowRange range) {
    ++done[static_cast<std::size_t>(stage * rows + j)];
    EXPECT_TRUE(j == range.begin || done[static_cast<std::size_t>(stage * rows + j - 1)] == 1);
    const auto& from = v[static_cast<std::size_t>((stage + 1) % 2)];
    const auto at = [&](int i) { return i < 0 || i >= rows ? 1 : from[static_cast<std::size_t>(i)]; };
    v[static_cast<std::size_t>(stage % 2)][static_cast<std::size_t>(j)] =
        stage == 0 ? static_cast<unsigned long>(j) : at(j - reach) + 3 * at(j) + 5 * at(j + reach);
  };
  if (one_by_one)
    for (int stage = 0; stage < stages; ++stage)
      for (int j = 0; j < rows; ++j) work(stage, j, {0, rows});
  else
    Wavefront(rows, stages, reach).run(work);
  for (int count : done) EXPECT_EQ(count, 1);
  return v[static_cast<std::size_t>((stages - 1) % 2)];
}

TEST(Wavefront, does_the_same_as_one_stage_after_another) {
  const int before = omp_get_max_threads();
  for (int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    for (int rows : {1, 2, 3, 5, 23, 24, 47, 48, 49, 119, 120, 131, 500, 2051})
      for (int stages : {1, 2, 5})
        for (int reach : {0, 1, 2, 3})
          EXPECT_EQ(smoothed(rows, stages, reach, false), smoothed(rows, stages, reach, true))
              << rows << " rows, " << stages << " stages, reach " << reach << ", threads " << threads;
  }
  omp_set_num_threads(before);
}

}  // namespace
}  // namespace batten
