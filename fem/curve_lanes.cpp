// SPDX-License-Identifier: MIT
#include <batten/fem/lane_squares.h>

// Kernels are compiled for the instruction sets of the x86-64 levels and chosen at start; other processors get the
// plain ones.

namespace batten {

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void gather_lanes(const double* const* lines, int count, LaneStep* steps) {
  int k = 0;
  for (; k + lane_chunk <= count; k += lane_chunk) gather_chunk(lines, k, steps + k);
  for (; k < count; ++k)
    for (int l = 0; l < lane_count; ++l) steps[k].value[l] = lines[l][k];
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void gather_differences(const double* const* lines, int count, double scale, LaneStep* steps) {
  int k = 0;
  for (; k + lane_chunk <= count; k += lane_chunk) gather_difference_chunk(lines, k, scale, steps + k);
  for (; k < count; ++k)
    for (int l = 0; l < lane_count; ++l) steps[k].value[l] = (lines[l][k + 1] - lines[l][k]) * scale;
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void scatter_lanes(const LaneStep* steps, int count, double* const* lines) {
  int k = 0;
  for (; k + lane_chunk <= count; k += lane_chunk) scatter_chunk(steps + k, lines, k, lane_foresight);
  for (; k < count; ++k)
    for (int l = 0; l < lane_count; ++l) lines[l][k] = steps[k].value[l];
}

}  // namespace batten
