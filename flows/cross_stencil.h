// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/tensor_sum.h>
#include <batten/fem/data_term.h>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace batten {

/// What couples row i of the first of two data terms: `own` with the same row of the second, `beside` with the other
/// row of its pair, unless it is empty.
struct CrossWeights {
  std::vector<double> own, beside;
};

/// X = Σ_i a_i (own_i b_i + beside_i b_i')^T of two data terms that measure with the same rows on spaces of one size:
/// (2d+1)² entries for each coefficient of the first, image by image.
class CrossStencil {
public:
  CrossStencil() = default;
  /// a_i and b_i are the rows of `first` and `second`, which are terms on spaces like `space`.
  CrossStencil(const SplineSpace& space, const DataTerm& first, const DataTerm& second, const CrossWeights& weights);

  /// R^T X S on the coarser level, of restrictions R^T of the first and S^T of the second.
  CrossStencil galerkin(const TensorSum& first, const TensorSum& second) const;

  bool is_empty() const { return entries_.empty(); }
  /// Entry of coefficient (i, j) of the first and (i + dx, j + dy) of the second.
  double entry(int i, int j, int dx, int dy) const { return row(i, j, dy)[dx + degree_]; }
  /// first += factor X second_c, second += factor X^T first_c; the same bits for every thread count.
  void add_products(double factor, std::span<const double> first_c, std::span<const double> second_c,
                    std::span<double> first, std::span<double> second) const;
  /// Adds Σ_k |X_ik| to first_i and Σ_i |X_ik| to second_k.
  void add_absolute_sums(std::span<double> first, std::span<double> second) const;

private:
  static constexpr int lanes = 8;

  CrossStencil(int rows, int columns, int degree);
  std::vector<double> reduce_columns(const BandedRows& first, const BandedRows& second, int begin, int end) const;

  void accumulate(int cell_row, const DataTerm& first, const DataTerm& second, const CrossWeights& weights);
  void add_product(double weight, const PointRow& a, const PointRow& b);
  /// Entries of (i, j) and (i - d ... i + d, j + dy), then zeros.
  const double* row(int i, int j, int dy) const {
    const auto k = static_cast<std::ptrdiff_t>(j) * columns_ + i;
    return entries_.data() + (k * (2 * degree_ + 1) + dy + degree_) * width_;
  }
  double* row(int i, int j, int dy) { return const_cast<double*>(std::as_const(*this).row(i, j, dy)); }
  std::ptrdiff_t block() const { return (2 * degree_ + 1) * width_; }  // the entries of one coefficient

  int rows_ = 0, columns_ = 0, degree_ = 0;
  int width_ = 0;                // 2d + 1, made a multiple of the lanes
  std::vector<double> entries_;  // [coefficient of the first][dy + d][dx + d]
};

}  // namespace batten
