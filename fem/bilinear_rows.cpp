// SPDX-License-Identifier: MIT
#include <batten/fem/bilinear_rows.h>

#include <algorithm>
#include <cstring>

// Compiled for the instruction sets of the x86-64 levels and chosen at start, as the kernels of TensorSum are.
// Neighbours come from shuffled registers: to load them from between cache lines takes twice as long.

namespace batten {
namespace {

constexpr int lanes = 8;
using Lanes [[gnu::vector_size(lanes * sizeof(double))]] = double;

[[gnu::always_inline]] inline Lanes load(const double* p) {
  Lanes v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
[[gnu::always_inline]] inline void store(Lanes v, double* p) { std::memcpy(p, &v, sizeof v); }
/// The first n lanes.
[[gnu::always_inline]] inline void store_within(Lanes v, double* p, std::ptrdiff_t n) {
  if (n >= lanes)
    store(v, p);
  else
    std::memcpy(p, &v, static_cast<std::size_t>(n) * sizeof(double));
}

/// (a_1 .. a_7, b_0) and the like, by the number of lanes of b.
[[gnu::always_inline]] inline Lanes shifted_1(Lanes a, Lanes b) {
  return __builtin_shufflevector(a, b, 1, 2, 3, 4, 5, 6, 7, 8);
}
[[gnu::always_inline]] inline Lanes shifted_2(Lanes a, Lanes b) {
  return __builtin_shufflevector(a, b, 2, 3, 4, 5, 6, 7, 8, 9);
}
[[gnu::always_inline]] inline Lanes shifted_7(Lanes a, Lanes b) {
  return __builtin_shufflevector(a, b, 7, 8, 9, 10, 11, 12, 13, 14);
}

/// What a vector of columns of the three rows gives to itself and to its neighbours.
struct Parts {
  Lanes near, far;
};

template <bool has_before>
[[gnu::always_inline]] inline void stencil(const BilinearWeights& weights, const BilinearInputs& in, double* out,
                                           std::ptrdiff_t n) {
  const auto [near, far] = weights;
  const auto [rows, gain, right_side, keep, before, soon] = in;
  const auto parts = [&](std::ptrdiff_t i) [[gnu::always_inline]] {
    const Lanes a = load(rows[0] + i), b = load(rows[1] + i), c = load(rows[2] + i);
    return Parts{near[0] * a + near[1] * b + near[2] * c, far[0] * a + far[1] * b + far[2] * c};
  };
  Lanes left = parts(-lanes).far;
  Parts at = parts(0);
  for (std::ptrdiff_t i = 0; i < n; i += lanes) {
    __builtin_prefetch(soon[0] + i);
    __builtin_prefetch(soon[1] + i);
    const Parts right = parts(i + lanes);
    const Lanes beside = shifted_7(left, at.far) + shifted_1(at.far, right.far);
    Lanes value = gain * load(right_side + i) + (at.near + beside);
    if constexpr (has_before) value -= keep * load(before + i);
    store_within(value, out + i, n - i);
    left = at.far;
    at = right;
  }
}

/// Lanes i .. of the sum; 0 for those that are not in first .. end - 1.
Lanes sum_within(const RowSum& sum, std::ptrdiff_t i, std::ptrdiff_t first, std::ptrdiff_t end) {
  double v[lanes] = {};
  for (std::ptrdiff_t k = std::max(i, first); k < std::min(i + lanes, end); ++k)
    for (int q = 0; q < sum.count; ++q) v[k - i] += sum.weights[q] * sum.rows[q][k];
  return load(v);
}

template <int count, bool adds>
[[gnu::always_inline]] inline void refine(const BetweenWeights& weights, const double* add, const RowSum& c,
                                          std::ptrdiff_t first, std::ptrdiff_t end, double* out, std::ptrdiff_t n) {
  const auto [all, w, rows] = c;
  const auto sum = [&](std::ptrdiff_t i) [[gnu::always_inline]] {
    if (i < first || i + lanes > end) return sum_within(c, i, first, end);
    Lanes v = w[0] * load(rows[0] + i);
    for (int q = 1; q < count; ++q) v += w[q] * load(rows[q] + i);
    return v;
  };
  const auto [even, near, far] = weights;
  Lanes left = sum(-lanes), at = sum(0);
  for (std::ptrdiff_t i = 0; i < n; i += lanes) {
    const Lanes right = sum(i + lanes);
    const Lanes on = even * at;
    const Lanes between = near * (at + shifted_1(at, right)) + far * (shifted_7(left, at) + shifted_2(at, right));
    Lanes lower = __builtin_shufflevector(on, between, 0, 8, 1, 9, 2, 10, 3, 11);
    Lanes upper = __builtin_shufflevector(on, between, 4, 12, 5, 13, 6, 14, 7, 15);
    if constexpr (adds) {
      lower += load(add + 2 * i);
      upper += load(add + 2 * i + lanes);
    }
    store(lower, out + 2 * i);
    store(upper, out + 2 * i + lanes);
    left = at;
    at = right;
  }
}

template <bool adds>
[[gnu::always_inline]] inline void refine(const BetweenWeights& weights, const double* add, const RowSum& c,
                                          std::ptrdiff_t first, std::ptrdiff_t end, double* out, std::ptrdiff_t n) {
  if (c.count == 1) return refine<1, adds>(weights, add, c, first, end, out, n);
  if (c.count == 2) return refine<2, adds>(weights, add, c, first, end, out, n);
  if (c.count == 3) return refine<3, adds>(weights, add, c, first, end, out, n);
  refine<4, adds>(weights, add, c, first, end, out, n);
}

template <int count>
[[gnu::always_inline]] inline void restricted(double even, double near, const RowSum& r, double* out,
                                              std::ptrdiff_t n) {
  const auto [all, w, rows] = r;
  const auto sum = [&](std::ptrdiff_t i) [[gnu::always_inline]] {
    Lanes v = w[0] * load(rows[0] + i);
    for (int q = 1; q < count; ++q) v += w[q] * load(rows[q] + i);
    return v;
  };
  Lanes odd_before = sum(-lanes);
  for (std::ptrdiff_t i = 0; i < n; i += lanes) {
    const Lanes a = sum(2 * i), b = sum(2 * i + lanes);
    const Lanes on = __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14);
    const Lanes odd = __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15);
    const Lanes value = even * on + near * (shifted_7(odd_before, odd) + odd);
    store_within(value, out + i, n - i);
    odd_before = odd;
  }
}

}  // namespace

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void bilinear_row(const BilinearWeights& weights, const BilinearInputs& in, double* out, std::ptrdiff_t n) {
  in.before ? stencil<true>(weights, in, out, n) : stencil<false>(weights, in, out, n);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void refine_row(const BetweenWeights& weights, const double* add, const RowSum& c, std::ptrdiff_t first,
                std::ptrdiff_t end, double* out, std::ptrdiff_t n) {
  add ? refine<true>(weights, add, c, first, end, out, n) : refine<false>(weights, add, c, first, end, out, n);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void restrict_row(double even, double near, const RowSum& r, double* out, std::ptrdiff_t n) {
  if (r.count == 1) return restricted<1>(even, near, r, out, n);
  if (r.count == 2) return restricted<2>(even, near, r, out, n);
  if (r.count == 3) return restricted<3>(even, near, r, out, n);
  restricted<4>(even, near, r, out, n);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void copy_row(const double* a, double* __restrict out, std::ptrdiff_t n) {
#pragma omp simd
  for (std::ptrdiff_t i = 0; i < n; ++i) out[i] = 1. * a[i];  // not by the library's copy, which starts slowly
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void add_row(const double* a, double* __restrict out, std::ptrdiff_t n) {
#pragma omp simd
  for (std::ptrdiff_t i = 0; i < n; ++i) out[i] += a[i];
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void multiply_rows(double factor, const double* a, const double* b, double* __restrict out, std::ptrdiff_t n) {
#pragma omp simd
  for (std::ptrdiff_t i = 0; i < n; ++i) out[i] = factor * (a[i] * b[i]);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
double
sum_of_changes(const double* s, const double* x, double scale, const double* first, const double* r, std::ptrdiff_t n) {
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double start = s ? s[i] : 0;
    sum += (x[i] - start) * (scale * (first[i] - start) + r[i]);
  }
  return sum;
}

}  // namespace batten
