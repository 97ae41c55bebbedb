// SPDX-License-Identifier: MIT
#include <batten/bases/even_stencil.h>

#include <algorithm>
#include <array>

// Compiled for the instruction sets of the x86-64 levels and chosen at start, as the kernels of TensorSum are.

namespace batten {
namespace {

constexpr int piece_columns = 576;  // rows combined for so many columns stay in the first-level cache
constexpr int buffer_columns = piece_columns + 16;

template <int reach>
[[gnu::always_inline]] inline void combine(const double* weights, const double* const* in, int from, int n,
                                           double (*buffer)[buffer_columns]) {
  double w[reach + 1][reach + 1];
  const double* rows[2 * reach + 1];
  for (int q = 0; q <= 2 * reach; ++q) rows[q] = in[q] + from;
  for (int q = 0; q <= reach; ++q)
    for (int p = 0; p <= reach; ++p) w[q][p] = weights[q * (reach + 1) + p];
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    double pair[reach + 1];
    pair[0] = rows[reach][i];
    for (int p = 1; p <= reach; ++p) pair[p] = rows[reach - p][i] + rows[reach + p][i];
    for (int q = 0; q <= reach; ++q) {
      double sum = w[q][0] * pair[0];
      for (int p = 1; p <= reach; ++p) sum += w[q][p] * pair[p];
      buffer[q][i] = sum;
    }
  }
}

template <int reach>
[[gnu::always_inline]] inline void even_row(const double* weights, const double* const* in, ColumnRange columns,
                                            double* __restrict out) {
  double buffer[reach + 1][buffer_columns];
  for (int from = columns.begin; from < columns.end; from += piece_columns) {
    const int n = std::min(piece_columns, columns.end - from);
    combine<reach>(weights, in, from - reach, n + 2 * reach, buffer);
    double* __restrict result = out + (from - columns.begin);
#pragma omp simd
    for (int i = 0; i < n; ++i) {
      double sum = buffer[0][i + reach];
      for (int q = 1; q <= reach; ++q) sum += buffer[q][i + reach - q] + buffer[q][i + reach + q];
      result[i] = sum;
    }
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void dispatch(int reach, const double* weights, const double* const* in, ColumnRange columns, double* out) {
  switch (reach) {
    case 1:
      return even_row<1>(weights, in, columns, out);
    case 2:
      return even_row<2>(weights, in, columns, out);
    case 3:
      return even_row<3>(weights, in, columns, out);
    case 4:
      return even_row<4>(weights, in, columns, out);
    default:
      return even_row<5>(weights, in, columns, out);
  }
}

/// True if the repeating rows of the band are even about the diagonal.
bool is_even(const BandedRows& band, int row) {
  const auto w = band.row(row);
  return band.period == 1 && band.shift == 1 && band.width % 2 == 1 && std::equal(w.begin(), w.end(), w.rbegin()) &&
         band.first[static_cast<std::size_t>(row)] + band.width / 2 == row;
}

}  // namespace

std::optional<EvenStencil> EvenStencil::inside(const TensorSum& sum) {
  EvenStencil result;
  const auto& first = sum.terms().front();
  result.reach_ = first.y.width / 2;
  if (first.x.width != first.y.width || result.reach_ < 1 || result.reach_ > 5) return {};
  result.rows_ = {0, first.y.rows};
  result.inner_ = {0, first.x.rows};
  for (const auto& term : sum.terms()) {
    result.rows_ = {std::max(result.rows_.begin, term.y.begin), std::min(result.rows_.end, term.y.end)};
    result.inner_ = {std::max(result.inner_.begin, term.x.begin), std::min(result.inner_.end, term.x.end)};
  }
  if (result.rows_.begin >= result.rows_.end || result.inner_.begin >= result.inner_.end) return {};
  for (const auto& term : sum.terms())
    if (!is_even(term.y, result.rows_.begin) || !is_even(term.x, result.inner_.begin)) return {};
  result.add_weights(sum);
  return result;
}

void EvenStencil::add_weights(const TensorSum& sum) {
  const int r = reach_, columns = sum.output_columns();
  const auto weight = [&](int column, int q, int p) {
    double result = 0;
    for (const auto& term : sum.terms())
      result += term.factor * term.y.scale * term.x.scale * term.y.row(rows_.begin)[static_cast<std::size_t>(r + p)] *
                term.x.row(column)[static_cast<std::size_t>(q)];
    return result;
  };
  for (int q = 0; q <= r; ++q)
    for (int p = 0; p <= r; ++p) weights_.push_back(weight(inner_.begin, r + q, p));
  for (int i = 0; i < columns; ++i) {
    if (i >= inner_.begin && i < inner_.end) continue;
    Edge edge{sum.terms().front().x.first[static_cast<std::size_t>(i)], {}};
    for (int q = 0; q <= 2 * r; ++q)
      for (int p = 0; p <= r; ++p) edge.weights.push_back(weight(i, q, p));
    edges_.push_back(std::move(edge));
  }
}

/// Columns that are edges.
void EvenStencil::edge_columns(const double* const* in, ColumnRange columns, double* out) const {
  for (int i = columns.begin; i < columns.end; ++i) {
    const Edge& edge = edges_[static_cast<std::size_t>(i < inner_.begin ? i : i - (inner_.end - inner_.begin))];
    const double* w = edge.weights.data();
    double sum = 0;
    for (int q = 0; q <= 2 * reach_; ++q) {
      const int k = edge.first + q;
      sum += *w++ * in[reach_][k];
      for (int p = 1; p <= reach_; ++p) sum += *w++ * (in[reach_ - p][k] + in[reach_ + p][k]);
    }
    out[i - columns.begin] = sum;
  }
}

void EvenStencil::row(const double* const* in, ColumnRange columns, double* out) const {
  const ColumnRange inner = {std::clamp(inner_.begin, columns.begin, columns.end),
                             std::clamp(inner_.end, columns.begin, columns.end)};
  edge_columns(in, {columns.begin, inner.begin}, out);
  if (inner.begin < inner.end) dispatch(reach_, weights_.data(), in, inner, out + (inner.begin - columns.begin));
  edge_columns(in, {inner.end, columns.end}, out + (inner.end - columns.begin));
}

}  // namespace batten
