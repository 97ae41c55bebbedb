// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/bases/tensor_sum.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <array>

// The kernels are compiled for the instruction sets of the x86-64 levels and chosen at start; other processors get the
// plain one.

namespace batten {
namespace {

/// buffer[t][i] = Σ_q weights[t][q] in[q][from + i]: the y part of all terms in one pass over the rows of the input.
template <int terms, int width>
[[gnu::always_inline]] inline void combine_rows(const double* const* weights, const double* const* in, int from, int n,
                                                double* const* buffer) {
  double w[terms][width];
  const double* rows[width];
  for (int q = 0; q < width; ++q) rows[q] = in[q] + from;
  for (int t = 0; t < terms; ++t)
    for (int q = 0; q < width; ++q) w[t][q] = weights[t][q];
  double* __restrict out0 = buffer[0];
  double* __restrict out1 = buffer[terms > 1 ? 1 : 0];
  double* __restrict out2 = buffer[terms > 2 ? 2 : 0];
  double* __restrict out3 = buffer[terms > 3 ? 3 : 0];
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    double sum0 = 0, sum1 = 0, sum2 = 0, sum3 = 0;
    for (int q = 0; q < width; ++q) {
      const double value = rows[q][i];
      sum0 += w[0][q] * value;
      if constexpr (terms > 1) sum1 += w[1][q] * value;
      if constexpr (terms > 2) sum2 += w[2][q] * value;
      if constexpr (terms > 3) sum3 += w[3][q] * value;
    }
    out0[i] = sum0;
    if constexpr (terms > 1) out1[i] = sum1;
    if constexpr (terms > 2) out2[i] = sum2;
    if constexpr (terms > 3) out3[i] = sum3;
  }
}

/// out[i * period] = Σ_t factor[t] Σ_q weights[t][q] in[t][i * shift + q]: repeating rows of the x part. The factors
/// multiply after the sums, so that integer weights with vanishing row sums annihilate the null space of the energy.
template <int terms, int width, int period, int shift>
[[gnu::always_inline]] inline void repeat_rows(const double* factors, const double* const* weights,
                                               const double* const* in, int n, double* out) {
  double w[terms][width];
  for (int t = 0; t < terms; ++t)
    for (int q = 0; q < width; ++q) w[t][q] = weights[t][q];
  const double* __restrict in0 = in[0];
  const double* __restrict in1 = in[terms > 1 ? 1 : 0];
  const double* __restrict in2 = in[terms > 2 ? 2 : 0];
  const double* __restrict in3 = in[terms > 3 ? 3 : 0];
  double* __restrict result = out;
  const double factor0 = factors[0], factor1 = factors[terms > 1 ? 1 : 0], factor2 = factors[terms > 2 ? 2 : 0];
  const double factor3 = factors[terms > 3 ? 3 : 0];
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    double sum0 = 0, sum1 = 0, sum2 = 0, sum3 = 0;
    for (int q = 0; q < width; ++q) {
      sum0 += w[0][q] * in0[i * shift + q];
      if constexpr (terms > 1) sum1 += w[1][q] * in1[i * shift + q];
      if constexpr (terms > 2) sum2 += w[2][q] * in2[i * shift + q];
      if constexpr (terms > 3) sum3 += w[3][q] * in3[i * shift + q];
    }
    double sum = factor0 * sum0;
    if constexpr (terms > 1) sum += factor1 * sum1;
    if constexpr (terms > 2) sum += factor2 * sum2;
    if constexpr (terms > 3) sum += factor3 * sum3;
    result[i * period] = sum;
  }
}

/// One row is made piece by piece, so that the combined rows of the input stay in the first-level cache (and on the
/// stack).
constexpr int piece_inputs = 512;
constexpr int buffer_size = piece_inputs + 16;

struct RowTask {
  std::array<double, TensorSum::max_terms> factors;
  std::array<const double*, TensorSum::max_terms> y_weights;
  std::array<const double*, TensorSum::max_terms> x_weights;
  std::array<double*, TensorSum::max_terms> buffer;
};

template <int terms>
[[gnu::always_inline]] inline void dispatch_combine(int width, const RowTask& task, const double* const* in, int from,
                                                    int n) {
  switch (width) {
    case 1:
      return combine_rows<terms, 1>(task.y_weights.data(), in, from, n, task.buffer.data());
    case 2:
      return combine_rows<terms, 2>(task.y_weights.data(), in, from, n, task.buffer.data());
    case 3:
      return combine_rows<terms, 3>(task.y_weights.data(), in, from, n, task.buffer.data());
    case 4:
      return combine_rows<terms, 4>(task.y_weights.data(), in, from, n, task.buffer.data());
    case 5:
      return combine_rows<terms, 5>(task.y_weights.data(), in, from, n, task.buffer.data());
    case 6:
      return combine_rows<terms, 6>(task.y_weights.data(), in, from, n, task.buffer.data());
    case 7:
      return combine_rows<terms, 7>(task.y_weights.data(), in, from, n, task.buffer.data());
    case 9:
      return combine_rows<terms, 9>(task.y_weights.data(), in, from, n, task.buffer.data());
    case 11:
      return combine_rows<terms, 11>(task.y_weights.data(), in, from, n, task.buffer.data());
    default:
      break;
  }
  for (int t = 0; t < terms; ++t)
    for (int i = 0; i < n; ++i) {
      double sum = 0;
      for (int q = 0; q < width; ++q) sum += task.y_weights[static_cast<std::size_t>(t)][q] * in[q][from + i];
      task.buffer[static_cast<std::size_t>(t)][i] = sum;
    }
}

template <int terms, int period, int shift>
[[gnu::always_inline]] inline bool dispatch_repeat(int width, const RowTask& task, const double* const* in, int n,
                                                   double* out) {
  const double* const f = task.factors.data();
  const double* const* w = task.x_weights.data();
  switch (width) {
    case 1:
      repeat_rows<terms, 1, period, shift>(f, w, in, n, out);
      return true;
    case 2:
      repeat_rows<terms, 2, period, shift>(f, w, in, n, out);
      return true;
    case 3:
      repeat_rows<terms, 3, period, shift>(f, w, in, n, out);
      return true;
    case 4:
      repeat_rows<terms, 4, period, shift>(f, w, in, n, out);
      return true;
    case 5:
      repeat_rows<terms, 5, period, shift>(f, w, in, n, out);
      return true;
    case 6:
      repeat_rows<terms, 6, period, shift>(f, w, in, n, out);
      return true;
    case 7:
      repeat_rows<terms, 7, period, shift>(f, w, in, n, out);
      return true;
    case 9:
      repeat_rows<terms, 9, period, shift>(f, w, in, n, out);
      return true;
    case 11:
      repeat_rows<terms, 11, period, shift>(f, w, in, n, out);
      return true;
    default:
      return false;
  }
}

/// Rows from .. to - 1 of the x part one by one; `input` is the column that the buffers start at, `out` belongs to row
/// `from`.
template <int terms>
[[gnu::always_inline]] inline void single_rows(const TensorSum::Term* term, const RowTask& task, int from, int to,
                                               int input, double* out) {
  for (int i = from; i < to; ++i) {
    double sum = 0;
    for (std::size_t t = 0; t < terms; ++t) {
      const auto& x = term[t].x;
      const double* w = x.weights.data() + static_cast<std::ptrdiff_t>(i) * x.width;
      const double* in = task.buffer[t] + (x.first[static_cast<std::size_t>(i)] - input);
      double product = 0;
      for (int q = 0; q < x.width; ++q) product += w[q] * in[q];
      sum += task.factors[t] * product;
    }
    out[i - from] = sum;
  }
}

/// Rows from .. to - 1 of the repeating ones; false if there is no kernel for them.
template <int terms>
[[gnu::always_inline]] inline bool repeating_rows(const TensorSum::Term* term, RowTask& task, int from, int to,
                                                  int input, double* out) {
  const auto& x = term[0].x;
  for (int row = from; row < std::min(from + x.period, to); ++row) {
    const int n = (to - row + x.period - 1) / x.period;
    std::array<const double*, TensorSum::max_terms> in{};
    for (std::size_t t = 0; t < terms; ++t) {
      task.x_weights[t] = term[t].x.weights.data() + static_cast<std::ptrdiff_t>(row) * x.width;
      in[t] = task.buffer[t] + (x.first[static_cast<std::size_t>(row)] - input);
    }
    bool done = false;
    if (x.period == 1 && x.shift == 1)
      done = dispatch_repeat<terms, 1, 1>(x.width, task, in.data(), n, out + (row - from));
    else if (x.period == 2 && x.shift == 1)
      done = dispatch_repeat<terms, 2, 1>(x.width, task, in.data(), n, out + (row - from));
    else if (x.period == 1 && x.shift == 2)
      done = dispatch_repeat<terms, 1, 2>(x.width, task, in.data(), n, out + (row - from));
    if (!done) return false;
  }
  return true;
}

template <int terms>
[[gnu::always_inline]] inline void tensor_row(const TensorSum::Term* term, int j, const double* const* in,
                                              ColumnRange columns, double* out, RowTask& task) {
  const auto& y = term[0].y;
  const auto& x = term[0].x;
  for (std::size_t t = 0; t < terms; ++t)
    task.y_weights[t] = term[t].y.weights.data() + static_cast<std::ptrdiff_t>(j) * y.width;
  int width = y.width;
  const auto vanishes = [&](int q) {
    return std::all_of(task.y_weights.begin(), task.y_weights.begin() + terms,
                       [q](const double* w) { return w[q] == 0; });
  };
  while (width > 1 && vanishes(width - 1)) --width;
  for (; width > 1 && vanishes(0); --width, ++in)
    for (std::size_t t = 0; t < terms; ++t) ++task.y_weights[t];
  const int piece = piece_inputs / x.shift * x.period;
  for (int from = columns.begin, to = 0; from < columns.end; from = to) {
    const bool repeat = from >= x.begin && from < x.end;
    to = std::min({from + (repeat ? piece : piece_inputs / 4),
                   repeat           ? x.end
                   : from < x.begin ? x.begin
                                    : x.rows,
                   columns.end});
    const int input = x.first[static_cast<std::size_t>(from)];
    const int inputs = x.first[static_cast<std::size_t>(to - 1)] + x.width - input;
    dispatch_combine<terms>(width, task, in, input, inputs);
    if (!repeat || !repeating_rows<terms>(term, task, from, to, input, out + (from - columns.begin)))
      single_rows<terms>(term, task, from, to, input, out + (from - columns.begin));
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void tensor_row_1(const TensorSum::Term* term, int j, const double* const* in, ColumnRange columns, double* out,
                  RowTask& task) {
  tensor_row<1>(term, j, in, columns, out, task);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void tensor_row_2(const TensorSum::Term* term, int j, const double* const* in, ColumnRange columns, double* out,
                  RowTask& task) {
  tensor_row<2>(term, j, in, columns, out, task);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void tensor_row_3(const TensorSum::Term* term, int j, const double* const* in, ColumnRange columns, double* out,
                  RowTask& task) {
  tensor_row<3>(term, j, in, columns, out, task);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void tensor_row_4(const TensorSum::Term* term, int j, const double* const* in, ColumnRange columns, double* out,
                  RowTask& task) {
  tensor_row<4>(term, j, in, columns, out, task);
}

void check_shapes(const std::vector<TensorSum::Term>& terms) {
  if (terms.empty() || terms.size() > static_cast<std::size_t>(TensorSum::max_terms))
    throw InvalidInput("TensorSum: expected 1 to 4 terms, found " + std::to_string(terms.size()));
  for (const auto& term : terms)
    if (term.x.first != terms[0].x.first || term.y.first != terms[0].y.first || term.x.width != terms[0].x.width ||
        term.y.width != terms[0].y.width || term.x.columns != terms[0].x.columns ||
        term.y.columns != terms[0].y.columns)
      throw InvalidInput("TensorSum: expected terms of one shape and one band");
}

}  // namespace

TensorSum::TensorSum(std::vector<Term> terms) : terms_(std::move(terms)) {
  check_shapes(terms_);
  for (auto& term : terms_) {
    term.factor *= term.y.scale * term.x.scale;
    term.y.scale = term.x.scale = 1;
    for (std::size_t t = 0; t < terms_.size(); ++t) {  // the rows that repeat in all terms
      term.x.begin = std::max(term.x.begin, terms_[t].x.begin);
      term.x.end = std::min(term.x.end, terms_[t].x.end);
    }
  }
  for (auto& term : terms_) {
    term.x.begin = terms_.back().x.begin;
    term.x.end = terms_.back().x.end;
  }
}

void TensorSum::row(int j, const double* const* in, ColumnRange columns, double* out) const {
  std::array<double, static_cast<std::size_t>(max_terms * buffer_size)> buffers;
  RowTask task{};
  for (std::size_t t = 0; t < terms_.size(); ++t) {
    task.buffer[t] = buffers.data() + t * static_cast<std::size_t>(buffer_size);
    task.factors[t] = terms_[t].factor;
  }
  if (terms_.size() == 1) return tensor_row_1(terms_.data(), j, in, columns, out, task);
  if (terms_.size() == 2) return tensor_row_2(terms_.data(), j, in, columns, out, task);
  if (terms_.size() == 3) return tensor_row_3(terms_.data(), j, in, columns, out, task);
  tensor_row_4(terms_.data(), j, in, columns, out, task);
}

void TensorSum::row(int j, const double* in, double* out) const {
  std::array<const double*, 16> table;
  std::vector<const double*> long_table;
  const auto width = static_cast<std::size_t>(band_height());
  const double** rows = table.data();
  if (width > table.size()) {
    long_table.resize(width);
    rows = long_table.data();
  }
  for (std::size_t q = 0; q < width; ++q)
    rows[q] = in + (first_row(j) + static_cast<std::ptrdiff_t>(q)) * input_columns();
  row(j, rows, {0, output_columns()}, out);
}

void TensorSum::apply(std::span<const double> in, std::span<double> out) const {
  const auto n = static_cast<std::ptrdiff_t>(output_columns());
  for_blocks(RowBlocks(output_rows(), output_columns()), [&](int begin, int end) {
    for (int j = begin; j < end; ++j) row(j, in.data(), out.data() + j * n);
  });
}

}  // namespace batten
