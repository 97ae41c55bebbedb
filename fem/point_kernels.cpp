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
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void add_to_cell_sum(int functions, std::span<const PointRow> rows, std::span<const double> w, CellSum& sum) {
  with_constant<2, 6>(functions, [&](auto n) [[gnu::always_inline]] {
    for (std::size_t i = 0; i < rows.size(); ++i) add_products<n>(rows[i], w[i], sum.data());
  });
}

}  // namespace batten
