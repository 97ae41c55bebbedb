// SPDX-License-Identifier: MIT
#include <batten/fem/curve_lanes.h>

#include <type_traits>

// Kernels are compiled for the instruction sets of the x86-64 levels and chosen at start; other processors get the
// plain ones.

namespace batten {
namespace {

/// Lane l from the line that is at place l.
[[gnu::always_inline]] inline Lanes gathered(const double* const (&at)[lane_count], std::ptrdiff_t k) {
  return Lanes{at[0][k], at[1][k], at[2][k], at[3][k], at[4][k], at[5][k], at[6][k], at[7][k]};
}

/// Asks for what is needed a tile later: processors foresee few of so many lines that are read at once.
template <class Number>
[[gnu::always_inline]] inline void prefetch(Number* const (&at)[lane_count], std::ptrdiff_t k) {
  constexpr int writes = std::is_const_v<Number> ? 0 : 1, cache_line = 8;
  if (k % cache_line != 0) return;
  for (int l = 0; l < lane_count; ++l) __builtin_prefetch(at[l] + k + lane_tile, writes);
}

}  // namespace

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void gather_lanes(const double* const* lines, int count, LaneStep* steps) {
  const double* at[lane_count];
  for (int l = 0; l < lane_count; ++l) at[l] = lines[l];
  for (int k = 0; k < count; ++k) {
    prefetch(at, k);
    steps[k].value = gathered(at, k);
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void gather_differences(const double* const* lines, int count, double scale, LaneStep* steps) {
  if (count == 0) return;
  const double* at[lane_count];
  for (int l = 0; l < lane_count; ++l) at[l] = lines[l];
  Lanes last = gathered(at, 0);
  for (int k = 0; k < count; ++k) {
    prefetch(at, k);
    const Lanes next = gathered(at, k + 1);
    steps[k].value = (next - last) * scale;
    last = next;
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void scatter_lanes(const LaneStep* steps, int count, double* const* lines) {
  double* at[lane_count];
  for (int l = 0; l < lane_count; ++l) at[l] = lines[l];
  for (int k = 0; k < count; ++k) {
    prefetch(at, k);
    const Lanes value = steps[k].value;
    for (int l = 0; l < lane_count; ++l) at[l][k] = value[l];
  }
}

}  // namespace batten
