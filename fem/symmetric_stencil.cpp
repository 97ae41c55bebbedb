// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/bases/constant_width.h>
#include <batten/domains/errors.h>
#include <batten/fem/symmetric_stencil.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace batten {
namespace {

/// Columns first .. first + width - 1 of the matrix beside the diagonal, and the inputs they meet: out[i] += factor Σ_q
/// entry[q step + i] in[q + i], or in[q + i] - centre[i] where there is a centre.
struct RowTerms {
  int first, width;
  const double* entry;
  std::ptrdiff_t step;
  const double* in;
  const double* centre;
};

template <int width, bool has_centre>
[[gnu::always_inline]] inline void add_terms_of(const RowTerms& terms, double factor, double* __restrict out,
                                                std::ptrdiff_t begin, std::ptrdiff_t end) {
#pragma omp simd
  for (std::ptrdiff_t i = begin; i < end; ++i) {
    double sum = 0;
    for (int q = 0; q < width; ++q)
      sum += terms.entry[q * terms.step + i] * (has_centre ? terms.in[q + i] - terms.centre[i] : terms.in[q + i]);
    out[i] += factor * sum;
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void add_terms(const RowTerms& terms, double factor, double* out, std::ptrdiff_t begin, std::ptrdiff_t end) {
  with_constant<1, 11>(terms.width, [&](auto width) [[gnu::always_inline]] {
    if (terms.centre) return add_terms_of<width, true>(terms, factor, out, begin, end);
    add_terms_of<width, false>(terms, factor, out, begin, end);
  });
}

/// Columns begin .. end - 1 meet all of their terms; the few at both ends lack some.
void add_bounded(const RowTerms& terms, double factor, double* out, int columns) {
  const auto& [first, width, entry, step, in, centre] = terms;
  const int begin = std::min(columns, std::max(0, -first));
  const int end = std::clamp(columns - (first + width - 1), begin, columns);
  for (int i = 0; i < columns; ++i) {
    if (i == begin) i = end;  // the middle is left to the kernel
    for (int q = 0; q < width && i < columns; ++q)
      if (i + first + q >= 0 && i + first + q < columns)
        out[i] += factor * entry[q * step + i] * (in[q + i] - (centre ? centre[i] : 0));
  }
  if (begin < end) add_terms(terms, factor, out, begin, end);
}

/// Entries of A (I ⊗ X^T) between row j of A and row j + dy: [dx + degree][coarse column].
struct HalfProduct {
  int degree, columns;
  std::vector<double> values;
  HalfProduct(int rows, int d, int n)
      : degree(d), columns(n), values(static_cast<std::size_t>(rows) * (d + 1) * (2 * d + 1) * n) {}
  double* at(int j, int dy, int dx) {
    return values.data() +
           ((static_cast<std::ptrdiff_t>(j) * (degree + 1) + dy) * (2 * degree + 1) + dx + degree) * columns;
  }
};

/// (I ⊗ X) A (I ⊗ X^T) for one fine row j and its partner j + dy.
void reduce_columns(const SymmetricStencil& a, const BandedRows& x, int j, int dy, HalfProduct& half) {
  const int d = a.degree();
  for (int i = 0; i < x.rows; ++i)
    for (int dx = std::max(-d, -i); dx <= std::min(d, x.rows - 1 - i); ++dx) {
      const auto left = x.row(i), right = x.row(i + dx);
      const int p0 = x.first[static_cast<std::size_t>(i)], q0 = x.first[static_cast<std::size_t>(i + dx)];
      double sum = 0;
      for (int p = 0; p < x.width; ++p) {
        double inner = 0;
        const int from = std::max(0, p0 + p - d - q0), to = std::min(x.width - 1, p0 + p + d - q0);
        for (int q = from; q <= to; ++q)
          inner += right[static_cast<std::size_t>(q)] * a.entry(p0 + p, j, q0 + q - p0 - p, dy);
        sum += left[static_cast<std::size_t>(p)] * inner;
      }
      half.at(j, dy, dx)[i] = sum;
    }
}

/// Adds weight (row p, row q of the half product) to row j, entries dy of the result.
void add_rows(HalfProduct& half, int p, int q, double weight, SymmetricStencil& result, int j, int dy) {
  const int d = half.degree, n = half.columns;
  for (int dx = dy == 0 ? 0 : -d; dx <= d; ++dx) {
    double* out = result.entries(j, dx, dy).data();
    const int from = std::max(0, -dx), to = n - std::max(0, dx);
    const double* in = q >= p ? half.at(p, q - p, dx) : half.at(q, p - q, -dx) + dx;  // transposed below the diagonal
    for (int i = from; i < to; ++i) out[i] += weight * in[i];
  }
}

/// R 1 for a refinement given by its transpose, exactly 1 where R keeps constants.
std::vector<double> refined_ones(const BandedRows& restriction) {
  std::vector<double> result(static_cast<std::size_t>(restriction.columns));
  for (int i = 0; i < restriction.rows; ++i)
    for (int q = 0; q < restriction.width; ++q)
      result[static_cast<std::size_t>(restriction.first[static_cast<std::size_t>(i)] + q)] +=
          restriction.scale * restriction.row(i)[static_cast<std::size_t>(q)];
  for (double& v : result)
    if (std::abs(v - 1) < 1e-12) v = 1;  // rounding would bring back what row sums avoid
  return result;
}

}  // namespace

SymmetricStencil::SymmetricStencil(int rows, int columns, int degree)
    : rows_(rows), columns_(columns), degree_(degree) {
  if (degree < 1 || degree > 5)
    throw InvalidInput("SymmetricStencil: expected degree 1 to 5, found " + std::to_string(degree));
  values_.assign(static_cast<std::size_t>(rows) * planes() * static_cast<std::size_t>(columns), 0.);
}

/// Calls add(terms) for row j of the matrix, entry row by entry row.
template <typename Add>
void SymmetricStencil::for_terms(int j, std::span<const double> c, Add&& add) const {
  const int d = degree_, width = 2 * d + 1;
  const std::ptrdiff_t n = columns_;
  for (int dy = std::max(-d, -j); dy <= std::min(d, rows_ - 1 - j); ++dy) {
    const double* in = c.data() + (j + dy) * n;
    if (dy > 0) {
      add(RowTerms{-d, width, values_.data() + at(j, -d, dy), n, in - d, nullptr});
    } else if (dy < 0) {  // entry (dx, dy) of (i, j) is entry (-dx, -dy) of (i + dx, j + dy)
      add(RowTerms{-d, width, values_.data() + at(j + dy, d, -dy) - d, 1 - n, in - d, nullptr});
    } else {
      add(RowTerms{0, d + 1, values_.data() + at(j, 0, 0), n, in, nullptr});
      add(RowTerms{-d, d, values_.data() + at(j, d, 0) - d, 1 - n, in - d, nullptr});
    }
  }
}

void SymmetricStencil::add_row(int j, double factor, std::span<const double> c, double* out) const {
  for_terms(j, c, [&](const RowTerms& terms) { add_bounded(terms, factor, out, columns_); });
}

void SymmetricStencil::add_precise_row(int j, double factor, std::span<const double> c, double* out) const {
  if (row_sums_.empty()) return add_row(j, factor, c, out);
  const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(j) * columns_;
  const double *centre = c.data() + begin, *sums = row_sums_.data() + begin;
  for_terms(j, c, [&](RowTerms terms) {
    terms.centre = centre;
    add_bounded(terms, factor, out, columns_);
  });
#pragma omp simd
  for (int i = 0; i < columns_; ++i) out[i] += factor * sums[i] * centre[i];
}

void SymmetricStencil::add_product(double factor, std::span<const double> c, std::span<double> out) const {
  for_blocks(RowBlocks(rows_, columns_ * 16), [&](int begin, int end) {
    for (int j = begin; j < end; ++j) add_row(j, factor, c, out.data() + static_cast<std::ptrdiff_t>(j) * columns_);
  });
}

std::vector<double> SymmetricStencil::absolute_row_sums() const {
  std::vector<double> result(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_));
  for_blocks(RowBlocks(rows_, columns_ * 16), [&](int begin, int end) {
    for (int j = begin; j < end; ++j) {
      double* sums = result.data() + static_cast<std::ptrdiff_t>(j) * columns_;
      for (int dy = std::max(-degree_, -j); dy <= std::min(degree_, rows_ - 1 - j); ++dy)
        for (int dx = -degree_; dx <= degree_; ++dx)
          for (int i = std::max(0, -dx); i < std::min(columns_, columns_ - dx); ++i)
            sums[i] += std::abs(dy >= 0 ? entry(i, j, dx, dy) : entry(i + dx, j + dy, -dx, -dy));
    }
  });
  return result;
}

SymmetricStencil SymmetricStencil::galerkin(const TensorSum& restriction) const {
  const auto& term = restriction.terms().front();
  const auto& [factor, y, x] = term;
  HalfProduct half(rows_, degree_, x.rows);
  for_blocks(RowBlocks(rows_, columns_ * 16), [&](int begin, int end) {
    for (int j = begin; j < end; ++j)
      for (int dy = 0; dy <= std::min(degree_, rows_ - 1 - j); ++dy) reduce_columns(*this, x, j, dy, half);
  });
  SymmetricStencil result(y.rows, x.rows, degree_);
  const double scale = factor * factor;
  for_blocks(RowBlocks(y.rows, x.rows * 64), [&](int begin, int end) {
    for (int j = begin; j < end; ++j)
      for (int dy = 0; dy <= std::min(degree_, y.rows - 1 - j); ++dy)
        for (int p = 0; p < y.width; ++p)
          for (int q = 0; q < y.width; ++q) {
            const int row = y.first[static_cast<std::size_t>(j)] + p,
                      partner = y.first[static_cast<std::size_t>(j + dy)] + q;
            const double weight =
                scale * y.row(j)[static_cast<std::size_t>(p)] * y.row(j + dy)[static_cast<std::size_t>(q)];
            if (weight != 0 && std::abs(row - partner) <= degree_) add_rows(half, row, partner, weight, result, j, dy);
          }
  });
  if (!row_sums_.empty()) result.set_row_sums(galerkin_row_sums(restriction));
  return result;
}

/// R^T A R 1 = R^T (A 1 - A (1 - R 1)). Inside, R keeps constants.
std::vector<double> SymmetricStencil::galerkin_row_sums(const TensorSum& restriction) const {
  const auto& [factor, y, x] = restriction.terms().front();
  const auto of_y = refined_ones(y), of_x = refined_ones(x);
  std::vector<double> sums = row_sums_, missing;
  missing.reserve(sums.size());
  for (const double v : of_y)
    for (const double u : of_x) missing.push_back(1 - factor * v * u);
  add_product(-1, missing, sums);
  std::vector<double> result(static_cast<std::size_t>(y.rows) * static_cast<std::size_t>(x.rows));
  restriction.apply(sums, result);
  return result;
}

}  // namespace batten
