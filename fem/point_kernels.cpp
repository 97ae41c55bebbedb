// SPDX-License-Identifier: MIT
#include <batten/fem/point_kernels.h>

#include <algorithm>
#include <cstring>

namespace batten {
namespace {

/// Four doubles in one register (or two).
using Four [[gnu::vector_size(32)]] = double;

/// functions == 4 moves whole registers; functions == 3 may not touch the coefficient after the last one.
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
  Four sum = row.y[0] * load<functions>(c);
  for (int b = 1; b < functions; ++b) sum += row.y[static_cast<std::size_t>(b)] * load<functions>(c + b * stride);
  sum *= load<4>(row.x.data());
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

template <int functions>
[[gnu::always_inline]] inline void add(const PointRow& row, std::ptrdiff_t stride, double v, double* c) {
  c += row.first_y * stride + row.first_x;
  const Four x = v * load<4>(row.x.data());
  for (int b = 0; b < functions; ++b, c += stride)
    store<functions>(c, load<functions>(c) + row.y[static_cast<std::size_t>(b)] * x);
}

template <int functions>
[[gnu::always_inline]] inline void add_within(const PointRow& row, std::ptrdiff_t stride, double v, double* c,
                                              RowRange rows) {
  if (row.first_y >= rows.begin && row.first_y + functions <= rows.end) return add<functions>(row, stride, v, c);
  const Four x = v * load<4>(row.x.data());
  const int from = std::max(rows.begin - row.first_y, 0), to = std::min(rows.end - row.first_y, functions);
  for (int b = from; b < to; ++b) {
    double* at = c + (row.first_y + b) * stride + row.first_x;
    store<functions>(at, load<functions>(at) + row.y[static_cast<std::size_t>(b)] * x);
  }
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

}  // namespace

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v3", "default")]]
#endif
void point_values(const PointGrid& grid, std::span<const PointRow> rows, const double* c, double* out) {
  if (grid.functions == 4)
    for (std::size_t i = 0; i < rows.size(); ++i) out[i] = value<4>(rows[i], grid.stride, c);
  else
    for (std::size_t i = 0; i < rows.size(); ++i) out[i] = value<3>(rows[i], grid.stride, c);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v3", "default")]]
#endif
void add_point_values(const PointGrid& grid, std::span<const PointRow> rows, const double* v, double* c) {
  if (grid.functions == 4)
    for (std::size_t i = 0; i < rows.size(); ++i) add<4>(rows[i], grid.stride, v[i], c);
  else
    for (std::size_t i = 0; i < rows.size(); ++i) add<3>(rows[i], grid.stride, v[i], c);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v3", "default")]]
#endif
void add_point_products(const PointGrid& grid, std::span<const PointRow> rows, const double* w, double factor,
                        const double* c, double* out, RowRange within) {
  if (grid.functions == 4)
    for (std::size_t i = 0; i < rows.size(); ++i)
      add_within<4>(rows[i], grid.stride, factor * w[i] * value<4>(rows[i], grid.stride, c), out, within);
  else
    for (std::size_t i = 0; i < rows.size(); ++i)
      add_within<3>(rows[i], grid.stride, factor * w[i] * value<3>(rows[i], grid.stride, c), out, within);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void add_to_cell_sum(int functions, std::span<const PointRow> rows, std::span<const double> w, CellSum& sum) {
  if (functions == 4)
    for (std::size_t i = 0; i < rows.size(); ++i) add_products<4>(rows[i], w[i], sum.data());
  else
    for (std::size_t i = 0; i < rows.size(); ++i) add_products<3>(rows[i], w[i], sum.data());
}

}  // namespace batten
