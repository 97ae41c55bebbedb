// SPDX-License-Identifier: MIT
#include <batten/fem/bilinear_rows.h>

#include <algorithm>
#include <cstring>

// Neighbours come from shuffled registers: to load them from between cache lines takes twice as long. Registers of
// eight numbers are for x86-64-v4 alone, elsewhere such shuffles are compiled lane by lane; the other instruction sets
// are chosen at start, as for the kernels of TensorSum.

namespace batten {
namespace {

using Eight [[gnu::vector_size(8 * sizeof(double))]] = double;
using Four [[gnu::vector_size(4 * sizeof(double))]] = double;
using Two [[gnu::vector_size(2 * sizeof(double))]] = double;

template <typename Lanes>
constexpr std::ptrdiff_t lanes = sizeof(Lanes) / sizeof(double);

template <typename Lanes>
[[gnu::always_inline]] inline Lanes load(const double* p) {
  Lanes v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
template <typename Lanes>
[[gnu::always_inline]] inline void store(Lanes v, double* p) {
  std::memcpy(p, &v, sizeof v);
}
/// The first n lanes.
template <typename Lanes>
[[gnu::always_inline]] inline void store_within(Lanes v, double* p, std::ptrdiff_t n) {
  if (n >= lanes<Lanes>)
    store(v, p);
  else
    std::memcpy(p, &v, static_cast<std::size_t>(n) * sizeof(double));
}

/// As many lanes of a and b, one after another, as one of them has: from lane 1 on, from 2 on, from the last of a on.
[[maybe_unused, gnu::always_inline]] inline Eight from_1(Eight a, Eight b) {
  return __builtin_shufflevector(a, b, 1, 2, 3, 4, 5, 6, 7, 8);
}
[[maybe_unused, gnu::always_inline]] inline Four from_1(Four a, Four b) {
  return __builtin_shufflevector(a, b, 1, 2, 3, 4);
}
[[gnu::always_inline]] inline Two from_1(Two a, Two b) { return __builtin_shufflevector(a, b, 1, 2); }
[[maybe_unused, gnu::always_inline]] inline Eight from_2(Eight a, Eight b) {
  return __builtin_shufflevector(a, b, 2, 3, 4, 5, 6, 7, 8, 9);
}
[[maybe_unused, gnu::always_inline]] inline Four from_2(Four a, Four b) {
  return __builtin_shufflevector(a, b, 2, 3, 4, 5);
}
[[gnu::always_inline]] inline Two from_2(Two, Two b) { return b; }
[[maybe_unused, gnu::always_inline]] inline Eight from_last(Eight a, Eight b) {
  return __builtin_shufflevector(a, b, 7, 8, 9, 10, 11, 12, 13, 14);
}
[[maybe_unused, gnu::always_inline]] inline Four from_last(Four a, Four b) {
  return __builtin_shufflevector(a, b, 3, 4, 5, 6);
}
[[gnu::always_inline]] inline Two from_last(Two a, Two b) { return from_1(a, b); }

template <typename Lanes>
struct Pair {
  Lanes first, second;
};
/// a_0 b_0 a_1 b_1 ...
[[maybe_unused, gnu::always_inline]] inline Pair<Eight> zipped(Eight a, Eight b) {
  return {__builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11),
          __builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15)};
}
[[maybe_unused, gnu::always_inline]] inline Pair<Four> zipped(Four a, Four b) {
  return {__builtin_shufflevector(a, b, 0, 4, 1, 5), __builtin_shufflevector(a, b, 2, 6, 3, 7)};
}
[[gnu::always_inline]] inline Pair<Two> zipped(Two a, Two b) {
  return {__builtin_shufflevector(a, b, 0, 2), __builtin_shufflevector(a, b, 1, 3)};
}
/// The even lanes of both, and the odd ones.
[[maybe_unused, gnu::always_inline]] inline Pair<Eight> unzipped(Eight a, Eight b) {
  return {__builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14),
          __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15)};
}
[[maybe_unused, gnu::always_inline]] inline Pair<Four> unzipped(Four a, Four b) {
  return {__builtin_shufflevector(a, b, 0, 2, 4, 6), __builtin_shufflevector(a, b, 1, 3, 5, 7)};
}
[[gnu::always_inline]] inline Pair<Two> unzipped(Two a, Two b) { return zipped(a, b); }

/// What a vector of columns of the three rows gives to itself and to its neighbours.
template <typename Lanes>
struct Parts {
  Lanes near, far;
};

template <typename Lanes>
[[gnu::always_inline]] inline Parts<Lanes> parts_at(std::ptrdiff_t i, const BilinearWeights& w,
                                                    const double* const* c) {
  const Lanes a = load<Lanes>(c[0] + i), b = load<Lanes>(c[1] + i), d = load<Lanes>(c[2] + i);
  return {w.near[0] * a + w.near[1] * b + w.near[2] * d, w.far[0] * a + w.far[1] * b + w.far[2] * d};
}

template <typename Lanes, bool has_before>
[[gnu::always_inline]] inline void stencil(const BilinearWeights& weights, const BilinearInputs& inputs, double* out,
                                           std::ptrdiff_t n) {
  const BilinearWeights w = weights;  // copies, which `out` cannot change
  const BilinearInputs in = inputs;
  Lanes left = parts_at<Lanes>(-lanes<Lanes>, w, in.c).far;
  Parts<Lanes> at = parts_at<Lanes>(0, w, in.c);
  for (std::ptrdiff_t i = 0; i < n; i += lanes<Lanes>) {
    __builtin_prefetch(in.soon[0] + i);
    __builtin_prefetch(in.soon[1] + i);
    const Parts<Lanes> right = parts_at<Lanes>(i + lanes<Lanes>, w, in.c);
    const Lanes beside = from_last(left, at.far) + from_1(at.far, right.far);
    Lanes value = in.gain * load<Lanes>(in.b + i) + (at.near + beside);
    if constexpr (has_before) value -= in.keep * load<Lanes>(in.before + i);
    store_within(value, out + i, n - i);
    left = at.far;
    at = right;
  }
}

template <typename Lanes, int count>
[[gnu::always_inline]] inline Lanes sum_at(std::ptrdiff_t i, const RowSum& sum) {
  Lanes v = sum.weights[0] * load<Lanes>(sum.rows[0] + i);
  for (int q = 1; q < count; ++q) v += sum.weights[q] * load<Lanes>(sum.rows[q] + i);
  return v;
}

/// Numbers i .. i + count - 1 of the sum; 0 for those that are not in first .. end - 1.
void sum_within(const RowSum& sum, std::ptrdiff_t i, std::ptrdiff_t count, std::ptrdiff_t first, std::ptrdiff_t end,
                double* out) {
  std::fill_n(out, count, 0.);
  for (std::ptrdiff_t k = std::max(i, first); k < std::min(i + count, end); ++k)
    for (int q = 0; q < sum.count; ++q) out[k - i] += sum.weights[q] * sum.rows[q][k];
}

template <typename Lanes, int count>
[[gnu::always_inline]] inline Lanes sum_within(std::ptrdiff_t i, const RowSum& sum, std::ptrdiff_t first,
                                               std::ptrdiff_t end) {
  if (i >= first && i + lanes<Lanes> <= end) return sum_at<Lanes, count>(i, sum);
  double part[lanes<Lanes>];
  sum_within(sum, i, lanes<Lanes>, first, end, part);
  return load<Lanes>(part);
}

template <typename Lanes, int count, bool adds>
[[gnu::always_inline]] inline void refine(const BetweenWeights& weights, const double* add, const RowSum& coarse,
                                          std::ptrdiff_t first, std::ptrdiff_t end, double* out, std::ptrdiff_t n) {
  const RowSum c = coarse;  // a copy, which `out` cannot change
  const auto [even, near, far] = weights;
  Lanes left = sum_within<Lanes, count>(-lanes<Lanes>, c, first, end);
  Lanes at = sum_within<Lanes, count>(0, c, first, end);
  for (std::ptrdiff_t i = 0; i < n; i += lanes<Lanes>) {
    const Lanes right = sum_within<Lanes, count>(i + lanes<Lanes>, c, first, end);
    const Lanes on = even * at;
    const Lanes between = near * (at + from_1(at, right)) + far * (from_last(left, at) + from_2(at, right));
    auto [lower, upper] = zipped(on, between);
    if constexpr (adds) {
      lower += load<Lanes>(add + 2 * i);
      upper += load<Lanes>(add + 2 * i + lanes<Lanes>);
    }
    store(lower, out + 2 * i);
    store(upper, out + 2 * i + lanes<Lanes>);
    left = at;
    at = right;
  }
}

template <typename Lanes, bool adds>
[[gnu::always_inline]] inline void refine(const BetweenWeights& weights, const double* add, const RowSum& c,
                                          std::ptrdiff_t first, std::ptrdiff_t end, double* out, std::ptrdiff_t n) {
  if (c.count == 1) return refine<Lanes, 1, adds>(weights, add, c, first, end, out, n);
  if (c.count == 2) return refine<Lanes, 2, adds>(weights, add, c, first, end, out, n);
  if (c.count == 3) return refine<Lanes, 3, adds>(weights, add, c, first, end, out, n);
  refine<Lanes, 4, adds>(weights, add, c, first, end, out, n);
}

template <typename Lanes, int count>
[[gnu::always_inline]] inline void restricted(double even, double near, const RowSum& sum, double* out,
                                              std::ptrdiff_t n) {
  const RowSum r = sum;
  Lanes odd_before = sum_at<Lanes, count>(-lanes<Lanes>, r);
  for (std::ptrdiff_t i = 0; i < n; i += lanes<Lanes>) {
    const Lanes a = sum_at<Lanes, count>(2 * i, r), b = sum_at<Lanes, count>(2 * i + lanes<Lanes>, r);
    const auto [on, odd] = unzipped(a, b);
    const Lanes value = even * on + near * (from_last(odd_before, odd) + odd);
    store_within(value, out + i, n - i);
    odd_before = odd;
  }
}

template <typename Lanes>
[[gnu::always_inline]] inline void any_stencil(const BilinearWeights& weights, const BilinearInputs& in, double* out,
                                               std::ptrdiff_t n) {
  in.before ? stencil<Lanes, true>(weights, in, out, n) : stencil<Lanes, false>(weights, in, out, n);
}

template <typename Lanes>
[[gnu::always_inline]] inline void any_refine(const BetweenWeights& weights, const double* add, const RowSum& c,
                                              std::ptrdiff_t first, std::ptrdiff_t end, double* out, std::ptrdiff_t n) {
  add ? refine<Lanes, true>(weights, add, c, first, end, out, n)
      : refine<Lanes, false>(weights, add, c, first, end, out, n);
}

template <typename Lanes>
[[gnu::always_inline]] inline void any_restricted(double even, double near, const RowSum& r, double* out,
                                                  std::ptrdiff_t n) {
  if (r.count == 1) return restricted<Lanes, 1>(even, near, r, out, n);
  if (r.count == 2) return restricted<Lanes, 2>(even, near, r, out, n);
  if (r.count == 3) return restricted<Lanes, 3>(even, near, r, out, n);
  restricted<Lanes, 4>(even, near, r, out, n);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
const int numbers_in_registers = __builtin_cpu_supports("x86-64-v4") ? 8 : __builtin_cpu_supports("x86-64-v3") ? 4 : 2;

[[gnu::target("arch=x86-64-v4")]] void stencil_8(const BilinearWeights& weights, const BilinearInputs& in, double* out,
                                                 std::ptrdiff_t n) {
  any_stencil<Eight>(weights, in, out, n);
}
[[gnu::target("arch=x86-64-v3")]] void stencil_4(const BilinearWeights& weights, const BilinearInputs& in, double* out,
                                                 std::ptrdiff_t n) {
  any_stencil<Four>(weights, in, out, n);
}
[[gnu::target("arch=x86-64-v4")]] void refine_8(const BetweenWeights& weights, const double* add, const RowSum& c,
                                                std::ptrdiff_t first, std::ptrdiff_t end, double* out,
                                                std::ptrdiff_t n) {
  any_refine<Eight>(weights, add, c, first, end, out, n);
}
[[gnu::target("arch=x86-64-v3")]] void refine_4(const BetweenWeights& weights, const double* add, const RowSum& c,
                                                std::ptrdiff_t first, std::ptrdiff_t end, double* out,
                                                std::ptrdiff_t n) {
  any_refine<Four>(weights, add, c, first, end, out, n);
}
[[gnu::target("arch=x86-64-v4")]] void restricted_8(double even, double near, const RowSum& r, double* out,
                                                    std::ptrdiff_t n) {
  any_restricted<Eight>(even, near, r, out, n);
}
[[gnu::target("arch=x86-64-v3")]] void restricted_4(double even, double near, const RowSum& r, double* out,
                                                    std::ptrdiff_t n) {
  any_restricted<Four>(even, near, r, out, n);
}
#endif

}  // namespace

void bilinear_row(const BilinearWeights& weights, const BilinearInputs& in, double* out, std::ptrdiff_t n) {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  if (numbers_in_registers == 8) return stencil_8(weights, in, out, n);
  if (numbers_in_registers == 4) return stencil_4(weights, in, out, n);
#endif
  any_stencil<Two>(weights, in, out, n);
}

void refine_row(const BetweenWeights& weights, const double* add, const RowSum& c, std::ptrdiff_t first,
                std::ptrdiff_t end, double* out, std::ptrdiff_t n) {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  if (numbers_in_registers == 8) return refine_8(weights, add, c, first, end, out, n);
  if (numbers_in_registers == 4) return refine_4(weights, add, c, first, end, out, n);
#endif
  any_refine<Two>(weights, add, c, first, end, out, n);
}

void restrict_row(double even, double near, const RowSum& r, double* out, std::ptrdiff_t n) {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  if (numbers_in_registers == 8) return restricted_8(even, near, r, out, n);
  if (numbers_in_registers == 4) return restricted_4(even, near, r, out, n);
#endif
  any_restricted<Two>(even, near, r, out, n);
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

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
double
product_of_rows(const double* a, const double* b, std::ptrdiff_t n) {
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (std::ptrdiff_t i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace batten
