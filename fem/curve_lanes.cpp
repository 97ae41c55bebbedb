// SPDX-License-Identifier: MIT
#include <batten/fem/curve_lanes.h>

#include <cstring>
#include <type_traits>

// Two lanes by two steps are exchanged at a time, in registers that every processor with vectors has.

namespace batten {
namespace {

using Pair [[gnu::vector_size(2 * sizeof(double))]] = double;

Pair pair_at(const double* numbers) {
  Pair pair;
  std::memcpy(&pair, numbers, sizeof pair);
  return pair;
}

void store(Pair pair, double* numbers) { std::memcpy(numbers, &pair, sizeof pair); }

/// Asks for what is needed a tile later: processors foresee few of so many lines that are read at once.
template <class Number>
void prefetch_tile(Number* const* lines, int count) {
  constexpr int writes = std::is_const_v<Number> ? 0 : 1, cache_line = 8;
  for (int l = 0; l < lane_count; ++l)
    for (int k = 0; k < count; k += cache_line) __builtin_prefetch(lines[l] + k + lane_tile, writes);
}

/// Two steps of two lanes, or two lanes of two steps.
struct Square {
  Pair first, second;
};
Square exchanged(Pair a, Pair b) { return {Pair{a[0], b[0]}, Pair{a[1], b[1]}}; }

}  // namespace

void gather_lanes(const double* const* lines, int count, LaneStep* steps) {
  prefetch_tile(lines, count);
  for (int l = 0; l < lane_count; l += 2) {
    const double *const a = lines[l], *const b = lines[l + 1];
    auto* const out = reinterpret_cast<double*>(steps) + l;
    int k = 0;
    for (; k + 1 < count; k += 2) {
      const Square step = exchanged(pair_at(a + k), pair_at(b + k));
      store(step.first, out + lane_count * k);
      store(step.second, out + lane_count * (k + 1));
    }
    if (k < count) store(Pair{a[k], b[k]}, out + lane_count * k);
  }
}

void gather_differences(const double* const* lines, int count, double scale, LaneStep* steps) {
  if (count == 0) return;
  prefetch_tile(lines, count);
  for (int l = 0; l < lane_count; l += 2) {
    const double *const a = lines[l], *const b = lines[l + 1];
    auto* const out = reinterpret_cast<double*>(steps) + l;
    Pair last = {a[0], b[0]};
    int k = 0;
    for (; k + 1 < count; k += 2) {
      const Square next = exchanged(pair_at(a + k + 1), pair_at(b + k + 1));
      store((next.first - last) * scale, out + lane_count * k);
      store((next.second - next.first) * scale, out + lane_count * (k + 1));
      last = next.second;
    }
    if (k < count) store((Pair{a[k + 1], b[k + 1]} - last) * scale, out + lane_count * k);
  }
}

void scatter_lanes(const LaneStep* steps, int count, double* const* lines) {
  prefetch_tile(lines, count);
  for (int l = 0; l < lane_count; l += 2) {
    double *const a = lines[l], *const b = lines[l + 1];
    const auto* const in = reinterpret_cast<const double*>(steps) + l;
    int k = 0;
    for (; k + 1 < count; k += 2) {
      const Square lane = exchanged(pair_at(in + lane_count * k), pair_at(in + lane_count * (k + 1)));
      store(lane.first, a + k);
      store(lane.second, b + k);
    }
    if (k < count) a[k] = in[lane_count * k], b[k] = in[lane_count * k + 1];
  }
}

}  // namespace batten
