// SPDX-License-Identifier: MIT
#include <batten/bases/grid_rules.h>

#include <algorithm>

// The kernel is compiled for the instruction sets of the x86-64 levels and chosen at start; other processors get the
// plain one.

namespace batten {
namespace {

using Tap = GridRules::Tap;

constexpr int longest_pass = 8;        // taps at once: their weights stay in registers
constexpr std::ptrdiff_t chunk = 512;  // groups whose old rows and sums stay in the first cache

/// sums[r][g] (+)= Σ_t taps[t].weights[r] taps[t].old[g]
template <int arity, int count, bool adds>
[[gnu::always_inline]] inline void add_taps(const Tap* taps, std::ptrdiff_t begin, std::ptrdiff_t groups,
                                            double* sums) {
  double w[arity][count];
  const double* old[count];
  for (int t = 0; t < count; ++t) {
    for (int r = 0; r < arity; ++r) w[r][t] = taps[t].weights[static_cast<std::size_t>(r)];
    old[t] = taps[t].old + begin;
  }
  double* __restrict first = sums;
  double* __restrict second = sums + chunk;
  double* __restrict third = sums + (arity - 1) * chunk;
#pragma omp simd
  for (std::ptrdiff_t g = 0; g < groups; ++g) {
    double sum0 = adds ? first[g] : 0, sum1 = adds ? second[g] : 0, sum2 = adds && arity > 2 ? third[g] : 0;
    for (int t = 0; t < count; ++t) {
      const double value = old[t][g];
      sum0 += w[0][t] * value;
      sum1 += w[1][t] * value;
      if constexpr (arity > 2) sum2 += w[2][t] * value;
    }
    first[g] = sum0;
    second[g] = sum1;
    if constexpr (arity > 2) third[g] = sum2;
  }
}

template <int arity, bool adds>
[[gnu::always_inline]] inline void add_taps(int count, const Tap* taps, std::ptrdiff_t begin, std::ptrdiff_t groups,
                                            double* sums) {
  switch (count) {
    case 1:
      return add_taps<arity, 1, adds>(taps, begin, groups, sums);
    case 2:
      return add_taps<arity, 2, adds>(taps, begin, groups, sums);
    case 3:
      return add_taps<arity, 3, adds>(taps, begin, groups, sums);
    case 4:
      return add_taps<arity, 4, adds>(taps, begin, groups, sums);
    case 5:
      return add_taps<arity, 5, adds>(taps, begin, groups, sums);
    case 6:
      return add_taps<arity, 6, adds>(taps, begin, groups, sums);
    case 7:
      return add_taps<arity, 7, adds>(taps, begin, groups, sums);
    default:
      return add_taps<arity, longest_pass, adds>(taps, begin, groups, sums);
  }
}

template <int arity>
[[gnu::always_inline]] inline void refine_row(const std::vector<Tap>& taps, std::ptrdiff_t groups, double* sums,
                                              double* out) {
  const auto count = static_cast<int>(taps.size());
  for (std::ptrdiff_t begin = 0; begin < groups; begin += chunk) {
    const std::ptrdiff_t length = std::min(chunk, groups - begin);
    add_taps<arity, false>(std::min(count, longest_pass), taps.data(), begin, length, sums);
    for (int t = longest_pass; t < count; t += longest_pass)
      add_taps<arity, true>(std::min(count - t, longest_pass), taps.data() + t, begin, length, sums);
    double* __restrict fine = out + arity * begin;
    for (std::ptrdiff_t g = 0; g < length; ++g)
      for (int r = 0; r < arity; ++r) fine[arity * g + r] = sums[r * chunk + g];
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void refine_row_by_two(const std::vector<Tap>& taps, std::ptrdiff_t groups, double* sums, double* out) {
  refine_row<2>(taps, groups, sums, out);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void refine_row_by_three(const std::vector<Tap>& taps, std::ptrdiff_t groups, double* sums, double* out) {
  refine_row<3>(taps, groups, sums, out);
}

}  // namespace

GridRules::GridRules(const Mask2<double>& mask, int arity)
    : x_(axis_rules(mask, 0, arity)), y_(axis_rules(mask, 1, arity)) {
  const auto sets = group_weights(mask, x_, y_);
  for (int r = 0; r < arity; ++r) rows_.push_back(rows_of(&sets[static_cast<std::size_t>(y_.width * r)], y_.width));
}

std::vector<GridRules::Row> GridRules::rows_of(const std::vector<double>* sets, int count) {
  std::vector<Row> rows;
  std::vector<bool> is_done(static_cast<std::size_t>(count));
  for (int first = 0; first < count; ++first) {
    const auto& weights = sets[first];
    const bool is_zero = std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; });
    if (is_done[static_cast<std::size_t>(first)] || is_zero) continue;
    Row row{first, -1, weights};
    for (int second = count - 1; second > first && row.second < 0; --second)
      if (!is_done[static_cast<std::size_t>(second)] && sets[second] == weights) row.second = second;
    if (row.second >= 0) is_done[static_cast<std::size_t>(row.second)] = true;
    rows.push_back(std::move(row));
  }
  return rows;
}

GridRules::Work GridRules::work(std::ptrdiff_t old_row_length) const {
  std::size_t most = 1;
  for (const auto& rows : rows_) most = std::max(most, rows.size());
  Work work;
  work.rows.resize(most * static_cast<std::size_t>(old_row_length));
  work.sums.resize(static_cast<std::size_t>(x_.arity * chunk));
  work.taps.reserve(most * static_cast<std::size_t>(x_.width));
  return work;
}

void GridRules::collect_taps(const Row& row, const double* old, std::vector<Tap>& taps) const {
  for (int q = 0; q < x_.width; ++q) {
    Tap tap{old + q, {}};
    bool is_zero = true;
    for (int r = 0; r < x_.arity; ++r) {
      const double w = row.weights[static_cast<std::size_t>(q + x_.width * r)];
      tap.weights[static_cast<std::size_t>(r)] = w;
      is_zero = is_zero && w == 0;
    }
    if (!is_zero) taps.push_back(tap);
  }
}

void GridRules::fill_row(int residue, const double* old, std::ptrdiff_t stride, std::ptrdiff_t groups, Work& work,
                         double* out) const {
  const std::ptrdiff_t length = groups + x_.width - 1;
  double* sum = work.rows.data();
  work.taps.clear();
  for (const Row& row : rows_[static_cast<std::size_t>(residue)]) {
    const double* const first = old + row.first * stride;
    if (row.second < 0) {
      collect_taps(row, first, work.taps);
      continue;
    }
    const double* const second = old + row.second * stride;
    for (std::ptrdiff_t i = 0; i < length; ++i) sum[i] = first[i] + second[i];
    collect_taps(row, sum, work.taps);
    sum += length;
  }
  if (work.taps.empty()) work.taps.push_back({old, {}});
  if (x_.arity == 2)
    refine_row_by_two(work.taps, groups, work.sums.data(), out);
  else
    refine_row_by_three(work.taps, groups, work.sums.data(), out);
}

}  // namespace batten
