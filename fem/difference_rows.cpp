// SPDX-License-Identifier: MIT
#include <batten/bases/constant_width.h>
#include <batten/fem/difference_form.h>
#include <batten/fem/difference_rows.h>
#include <batten/fem/spline_space.h>

#include <algorithm>
#include <array>
#include <utility>

// Kernels are compiled for the instruction sets of the x86-64 levels and chosen at start; other processors get the
// plain ones.

namespace batten {
namespace {

constexpr int piece_columns = 512, buffer_columns = piece_columns + 16, most_rows = 11;
using Buffer = std::array<double, buffer_columns>;

/// D^T G for one difference: row i is slope_{i-1} G_{i-1} - slope_i G_i.
BandedRows differences_transposed(const BandedRows& g, const std::vector<double>& slopes) {
  BandedRows result;
  result.rows = g.rows + 1;
  result.columns = g.columns;
  result.width = std::min(g.width + 1, g.columns);
  result.scale = g.scale;
  for (int i = 0; i < result.rows; ++i) {
    const int above = g.first[static_cast<std::size_t>(std::max(i - 1, 0))];
    const int first = std::min(above, result.columns - result.width);
    result.first.push_back(first);
    for (int k = first; k < first + result.width; ++k) {
      double sum = i > 0 ? slopes[static_cast<std::size_t>(i - 1)] * g(i - 1, k) : 0;
      if (i < g.rows) sum -= slopes[static_cast<std::size_t>(i)] * g(i, k);
      result.weights.push_back(sum);
    }
  }
  find_repeating_rows(result);
  return result;
}

DifferenceRows::Direction direction(const SplineBasis& basis, int order) {
  DifferenceRows::Direction result;
  for (int k = 0; k < order; ++k) result.slopes.push_back(derivative_slopes(lowered(basis, k)));
  result.weights = lowered(basis, order).inner_products(0);
  result.scale = std::exchange(result.weights.scale, 1);
  for (int k = order - 1; k >= 0; --k)
    result.weights = differences_transposed(result.weights, result.slopes[static_cast<std::size_t>(k)]);
  if (!basis.is_periodic()) result.weights = with_constrained_rows(std::move(result.weights), basis.ends());
  return result;
}

/// in[0 .. count] becomes slopes[k] (in[k + 1] - in[k]), k < count.
[[gnu::always_inline]] inline void difference(const double* slopes, int count, double* in) {
#pragma omp simd
  for (int k = 0; k < count; ++k) in[k] = slopes[k] * (in[k + 1] - in[k]);
}

template <int width>
[[gnu::always_inline]] inline void combine(const double* weights, int n, const std::array<Buffer, most_rows>& rows,
                                           double* __restrict out) {
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t q = 0; q < width; ++q) sum += weights[q] * rows[q][static_cast<std::size_t>(i)];
    out[i] = sum;
  }
}

/// out[i] += factor Σ_q weights[q] in[i + q]
template <int width>
[[gnu::always_inline]] inline void add_filtered(double factor, const double* weights, int n, const double* in,
                                                double* __restrict out) {
  double w[width];
  for (int q = 0; q < width; ++q) w[q] = weights[q];
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    double sum = 0;
    for (int q = 0; q < width; ++q) sum += w[q] * in[i + q];
    out[i] += factor * sum;
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void combine_rows(const BandedRows& weights, int j, int n, const std::array<Buffer, most_rows>& rows, double* out) {
  const double* w = weights.weights.data() + static_cast<std::ptrdiff_t>(j) * weights.width;
  with_constant<1, most_rows>(weights.width,
                              [&](auto width) [[gnu::always_inline]] { combine<width>(w, n, rows, out); });
}

/// rows[q][i] for q < count becomes slopes[q] (rows[q + 1][i] - rows[q][i]).
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void difference_rows(const double* slopes, int count, int n, std::array<Buffer, most_rows>& rows) {
  for (std::size_t q = 0; q < static_cast<std::size_t>(count); ++q) {
    const double slope = slopes[q];
    double* __restrict low = rows[q].data();
    const double* __restrict high = rows[q + 1].data();
#pragma omp simd
    for (int i = 0; i < n; ++i) low[i] = slope * (high[i] - low[i]);
  }
}

/// out[i - from] += factor (row i of weights) (differences of g), g[0] at column piece.first.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void add_columns(const DifferenceRows::Direction& x, double factor, const DifferenceRows::Piece& piece, Buffer& g, double* out) {
  int count = piece.inputs;
  for (const auto& slopes : x.slopes) difference(slopes.data() + piece.first, --count, g.data());
  const auto& w = x.weights;
  const int begin = std::clamp(w.begin, piece.from, piece.to), end = std::clamp(w.end, begin, piece.to);
  for (int i = piece.from; i < piece.to; ++i) {
    if (i == begin) i = end;  // the middle is left to the kernel
    if (i >= piece.to) break;
    const double* weights = w.weights.data() + static_cast<std::ptrdiff_t>(i) * w.width;
    const double* in = g.data() + (w.first[static_cast<std::size_t>(i)] - piece.first);
    double sum = 0;
    for (int q = 0; q < w.width; ++q) sum += weights[q] * in[q];
    out[i - piece.from] += factor * sum;
  }
  if (begin < end)
    with_constant<1, most_rows>(w.width, [&](auto width) [[gnu::always_inline]] {
      add_filtered<width>(factor, w.weights.data() + static_cast<std::ptrdiff_t>(begin) * width, end - begin,
                          g.data() + (w.first[static_cast<std::size_t>(begin)] - piece.first),
                          out + (begin - piece.from));
    });
}

}  // namespace

DifferenceRows::DifferenceRows(const Energy& energy, const SplineSpace& space)
    : x_ends_(space.x.ends()), y_ends_(space.y.ends()), columns_(space.x.size()), rows_(space.y.size()) {
  int orders = 0;
  for (const auto& t : energy.terms()) orders = std::max({orders, t.x_order + 1, t.y_order + 1});
  for (int r = 0; r < orders; ++r) {
    x_.push_back(direction(space.x, r));
    y_.push_back(direction(space.y, r));
  }
  for (const auto& t : energy.terms()) {
    const double scale = x_[static_cast<std::size_t>(t.x_order)].scale * y_[static_cast<std::size_t>(t.y_order)].scale;
    terms_.push_back({t.weight * space.cell_factor(t.x_order, t.y_order) * scale, t.x_order, t.y_order});
  }
  std::stable_sort(terms_.begin(), terms_.end(), [](const Term& a, const Term& b) { return a.y_order < b.y_order; });
}

/// The columns of a row of c that a piece takes in. What conditions take away is 0 in c, but flat ends are those of
/// splines whose two last coefficients are equal.
void DifferenceRows::copy_row(int row, const Piece& piece, const double* c, double* to) const {
  if (row == 0 && y_ends_.lower == EndCondition::Flat) row = 1;
  if (row == rows_ - 1 && y_ends_.upper == EndCondition::Flat) row = rows_ - 2;
  std::copy_n(c + static_cast<std::ptrdiff_t>(row) * columns_ + piece.first, piece.inputs, to);
  if (piece.first == 0 && x_ends_.lower == EndCondition::Flat) to[0] = to[1];
  if (piece.first + piece.inputs == columns_ && x_ends_.upper == EndCondition::Flat)
    to[piece.inputs - 1] = to[piece.inputs - 2];
}

void DifferenceRows::row(int j, const double* c, double* out) const {
  std::array<Buffer, most_rows> rows;
  Buffer combined, g;
  std::fill_n(out, columns_, 0.);
  const auto& band = x_.front().weights;  // takes in all that the others do
  const int first_row = y_.front().weights.first[static_cast<std::size_t>(j)];
  for (int from = 0; from < columns_; from += piece_columns) {
    Piece piece{from, std::min(from + piece_columns, columns_), band.first[static_cast<std::size_t>(from)], 0};
    piece.inputs = band.first[static_cast<std::size_t>(piece.to - 1)] + band.width - piece.first;
    int height = y_.front().weights.width, order = 0;
    for (int q = 0; q < height; ++q) copy_row(first_row + q, piece, c, rows[static_cast<std::size_t>(q)].data());
    for (std::size_t t = 0; t < terms_.size(); ++t) {
      const auto& term = terms_[t];
      const auto& y = y_[static_cast<std::size_t>(term.y_order)];
      for (; order < term.y_order; ++order)
        difference_rows(y.slopes[static_cast<std::size_t>(order)].data() + first_row, --height, piece.inputs, rows);
      if (t == 0 || term.y_order != terms_[t - 1].y_order)
        combine_rows(y.weights, j, piece.inputs, rows, combined.data());
      std::copy_n(combined.data(), piece.inputs, g.data());
      add_columns(x_[static_cast<std::size_t>(term.x_order)], term.factor, piece, g, out + piece.from);
    }
  }
}

}  // namespace batten
