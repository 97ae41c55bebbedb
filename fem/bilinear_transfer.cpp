// SPDX-License-Identifier: MIT
#include <batten/fem/bilinear_rows.h>
#include <batten/fem/bilinear_transfer.h>

#include <algorithm>
#include <array>

namespace batten {
namespace {

constexpr int most_rows = 16;  // of a band

/// The y part of row j of a product, its input from a column on, without the rows of weight 0 at the ends.
RowSum row_sum(const TensorSum::Term& term, int j, const double* const* table, int column) {
  const auto w = term.y.row(j);
  std::size_t first = 0, end = w.size();
  while (end > 1 && w[end - 1] == 0) --end;
  while (first + 1 < end && w[first] == 0) ++first;
  RowSum sum;
  for (std::size_t q = first; q < end; ++q) {
    sum.weights[sum.count] = term.factor * w[q];
    sum.rows[sum.count++] = table[q] + column;
  }
  return sum;
}

/// Columns of a product whose weights in x differ; the sum begins at column `from` of the input.
void single_columns(const BandedRows& band, const RowSum& sum, int from, ColumnRange columns, double* out) {
  for (int i = columns.begin; i < columns.end; ++i) {
    const double* const w = band.weights.data() + static_cast<std::ptrdiff_t>(i) * band.width;
    const int first = band.first[static_cast<std::size_t>(i)] - from;
    double value = 0;
    for (int q = 0; q < sum.count; ++q) {
      double product = 0;
      for (int p = 0; p < band.width; ++p) product += w[p] * sum.rows[q][first + p];
      value += sum.weights[q] * product;
    }
    out[i] = value;
  }
}

/// Those of the columns whose weights repeat.
ColumnRange repeated(const BandedRows& band, ColumnRange columns) {
  return {std::clamp(band.begin, columns.begin, columns.end), std::clamp(band.end, columns.begin, columns.end)};
}

}  // namespace

bool halves_columns(const TensorSum& refinement) { return refinement.terms().front().x.period == 2; }

void refine_columns(const CoarseRows& from, int j, ColumnRange columns, const AddedRow& added, double* row) {
  const TensorSum& refinement = from.refinement;
  std::array<const double*, most_rows> table{};
  for (int q = 0; q < refinement.band_height(); ++q)
    table[static_cast<std::size_t>(q)] =
        from.coarse + static_cast<std::ptrdiff_t>(refinement.first_row(j) + q) * refinement.input_columns();
  const auto add = [&](int begin, int end) {
    if (added.row) add_row(added.row + begin, row + begin, end - begin);
  };
  const int begin = columns.begin, size = columns.end - begin;
  if (!halves_columns(refinement)) {
    refinement.row(j, table.data(), columns, row + begin);
    return add(begin, columns.end);
  }
  const auto& term = refinement.terms().front();
  const RowSum c = row_sum(term, j, table.data(), begin / 2);
  const ColumnRange inner = repeated(term.x, columns);
  const int even = (term.x.begin + 1) / 2 * 2, coarse = even / 2;  // of the columns that repeat
  const BetweenWeights weights = {term.x(even, coarse), term.x(even + 1, coarse), term.x(even + 1, coarse - 1)};
  const bool adds = added.row && added.has_more_behind;
  refine_row(weights, adds ? added.row + begin : nullptr, c, -begin / 2, term.x.columns - begin / 2, row + begin,
             (size + 1) / 2);
  if (!adds) add(inner.begin, inner.end);
  for (const ColumnRange ends : {ColumnRange{begin, inner.begin}, ColumnRange{inner.end, columns.end}}) {
    single_columns(term.x, c, begin / 2, ends, row);
    add(ends.begin, ends.end);
  }
}

void restrict_columns(const TensorSum& restriction, int k, const ResidualRows& from, ColumnRange coarse, double* out) {
  const auto& term = restriction.terms().front();
  const ColumnRange inner = repeated(term.x, coarse);
  if (term.x.shift != 2 || inner.begin >= inner.end) return restriction.row(k, from.rows, coarse, out + coarse.begin);
  const RowSum r = row_sum(term, k, from.rows, from.begin);
  const double even = term.x(inner.begin, 2 * inner.begin), near = term.x(inner.begin, 2 * inner.begin - 1);
  restrict_row(even, near, r, out + coarse.begin, inner.end - coarse.begin);
  single_columns(term.x, r, from.begin, {coarse.begin, inner.begin}, out);
  single_columns(term.x, r, from.begin, {inner.end, coarse.end}, out);
}

}  // namespace batten
