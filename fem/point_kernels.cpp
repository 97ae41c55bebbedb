// SPDX-License-Identifier: MIT
#include <batten/bases/constant_width.h>
#include <batten/fem/point_kernels.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace batten {
namespace {

/// Four doubles in one register (or two).
using Four [[gnu::vector_size(32)]] = double;

/// Up to four functions fill one register; four are moved whole, fewer may not touch the coefficient after the last
/// one.
template <int functions>
[[gnu::always_inline]] inline Four load(const double* p) {
  Four v{};
  std::memcpy(&v, p, functions * sizeof(double));
  return v;
}

template <int functions>
[[gnu::always_inline]] inline void store(double* p, Four v) {
  std::memcpy(p, &v, functions * sizeof(double));
}

template <int functions>
[[gnu::always_inline]] inline double value(const PointRow& row, std::ptrdiff_t stride, const double* c) {
  c += row.first_y * stride + row.first_x;
  if constexpr (functions <= 4) {
    Four sum = row.y[0] * load<functions>(c);
    for (int b = 1; b < functions; ++b) sum += row.y[static_cast<std::size_t>(b)] * load<functions>(c + b * stride);
    sum *= load<4>(row.x.data());
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
  } else {
    double sum = 0;
    for (int b = 0; b < functions; ++b) {
      double line = 0;
      for (int a = 0; a < functions; ++a) line += row.x[static_cast<std::size_t>(a)] * c[b * stride + a];
      sum += row.y[static_cast<std::size_t>(b)] * line;
    }
    return sum;
  }
}

/// c += v x for one row of coefficients.
template <int functions>
[[gnu::always_inline]] inline void add_line(double v, const double* x, double* c) {
  if constexpr (functions <= 4)
    store<functions>(c, load<functions>(c) + v * load<4>(x));
  else
    for (int a = 0; a < functions; ++a) c[a] += v * x[a];
}

template <int functions>
[[gnu::always_inline]] inline void add_within(const PointRow& row, std::ptrdiff_t stride, double v, double* c,
                                              RowRange rows) {
  const int from = std::max(rows.begin - row.first_y, 0), to = std::min(rows.end - row.first_y, functions);
  c += row.first_y * stride + row.first_x;
  if (from == 0 && to == functions)
    for (int b = 0; b < functions; ++b)
      add_line<functions>(v * row.y[static_cast<std::size_t>(b)], row.x.data(), c + b * stride);
  else
    for (int b = from; b < to; ++b)
      add_line<functions>(v * row.y[static_cast<std::size_t>(b)], row.x.data(), c + b * stride);
}

template <std::size_t n>
[[gnu::always_inline]] inline void add_products(const PointRow& row, double weight, double* sum) {
  double xx[n * n];
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t e = 0; e < n; ++e) xx[a * n + e] = row.x[a] * row.x[e];
  for (std::size_t b = 0; b < n; ++b)
    for (std::size_t f = b; f < n; ++f) {
      const double y = weight * row.y[b] * row.y[f];
      double* s = sum + (b * n + f) * n * n;
      for (std::size_t k = 0; k < n * n; ++k) s[k] += y * xx[k];
    }
}

template <std::size_t n>
[[gnu::always_inline]] inline void add_both_products(const PointRow& b_0, const PointRow& b_1, double x, double* sum) {
  double xx[n * n], transposed[n * n];
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t e = 0; e < n; ++e) xx[a * n + e] = transposed[e * n + a] = b_0.x[a] * b_1.x[e];
  for (std::size_t b = 0; b < n; ++b)
    for (std::size_t f = b; f < n; ++f) {
      const double y = x * b_0.y[b] * b_1.y[f], y_transposed = x * b_1.y[b] * b_0.y[f];
      double* s = sum + (b * n + f) * n * n;
      for (std::size_t k = 0; k < n * n; ++k) s[k] += y * xx[k] + y_transposed * transposed[k];
    }
}

constexpr RowRange all_rows = {0, std::numeric_limits<int>::max()};

}  // namespace

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v3", "default")]]
#endif
void point_values(const PointGrid& grid, std::span<const PointRow> rows, const double* c, double* out) {
  with_constant<2, 6>(grid.functions, [&](auto functions) [[gnu::always_inline]] {
    for (std::size_t i = 0; i < rows.size(); ++i) out[i] = value<functions>(rows[i], grid.stride, c);
  });
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v3", "default")]]
#endif
void add_point_values(const PointGrid& grid, std::span<const PointRow> rows, const double* v, double* c) {
  with_constant<2, 6>(grid.functions, [&](auto functions) [[gnu::always_inline]] {
    for (std::size_t i = 0; i < rows.size(); ++i) add_within<functions>(rows[i], grid.stride, v[i], c, all_rows);
  });
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v3", "default")]]
#endif
void add_point_products(const PointGrid& grid, std::span<const PointRow> rows, const double* w, double factor,
                        const double* c, double* out, RowRange within) {
  with_constant<2, 6>(grid.functions, [&](auto functions) [[gnu::always_inline]] {
    for (std::size_t i = 0; i < rows.size(); ++i)
      add_within<functions>(rows[i], grid.stride, factor * w[i] * value<functions>(rows[i], grid.stride, c), out,
                            within);
  });
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v3", "default")]]
#endif
void add_pair_products(const PointGrid& grid, std::span<const PointRow> rows, const PairPointers& weights,
                       double factor, const double* c, double* out, RowRange within) {
  with_constant<2, 6>(grid.functions, [&](auto functions) [[gnu::always_inline]] {
    for (std::size_t i = 0; i + 1 < rows.size(); i += 2) {
      const double a = factor * value<functions>(rows[i], grid.stride, c),
                   b = factor * value<functions>(rows[i + 1], grid.stride, c), x = weights.x[i / 2];
      add_within<functions>(rows[i], grid.stride, weights.w[i] * a + x * b, out, within);
      add_within<functions>(rows[i + 1], grid.stride, x * a + weights.w[i + 1] * b, out, within);
    }
  });
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void add_to_cell_sum(int functions, std::span<const PointRow> rows, std::span<const double> w, CellSum& sum) {
  with_constant<2, 6>(functions, [&](auto n) [[gnu::always_inline]] {
    for (std::size_t i = 0; i < rows.size(); ++i) add_products<n>(rows[i], w[i], sum.data());
  });
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void add_pair_to_cell_sum(int functions, const PointRow& b_0, const PointRow& b_1, double x, CellSum& sum) {
  with_constant<2, 6>(functions, [&](auto n) [[gnu::always_inline]] { add_both_products<n>(b_0, b_1, x, sum.data()); });
}

}  // namespace batten
