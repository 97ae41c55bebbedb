// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/tensor_sum.h>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace batten {

/// A symmetric matrix on a grid of coefficients whose entries couple coefficients at most `degree` columns and rows
/// apart: (2 degree + 1)² entries for each coefficient, of which the half with dy > 0 or dy = 0, dx >= 0 is kept.
class SymmetricStencil {
public:
  SymmetricStencil() = default;
  /// All entries zero. Throws InvalidInput unless the degree is from 1 to 5.
  SymmetricStencil(int rows, int columns, int degree);

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  int degree() const { return degree_; }

  /// Entry between coefficients (i, j) and (i + dx, j + dy), both on the grid, 0 <= dy <= degree.
  double entry(int i, int j, int dx, int dy) const {
    return dy == 0 && dx < 0 ? entry(i + dx, j, -dx, 0) : values_[at(j, dx, dy) + static_cast<std::size_t>(i)];
  }
  /// The kept entries (dx, dy) of row j, one for each column.
  std::span<double> entries(int j, int dx, int dy) {
    return {values_.data() + at(j, dx, dy), static_cast<std::size_t>(columns_)};
  }

  /// The sums of all rows where they are known better than by adding entries; those of derivatives vanish.
  void set_row_sums(std::vector<double> sums) { row_sums_ = std::move(sums); }
  std::span<const double> row_sums() const { return row_sums_; }

  /// out += factor (row j of the matrix) c, the row being that of the grid: columns() numbers.
  void add_row(int j, double factor, std::span<const double> c, double* out) const;
  /// The same by differences first where row sums are known, (A c)_i = Σ_k A_ik (c_k - c_i) + sum_i c_i: the rounding
  /// of the entries meets differences of neighbours and not their values, which gains a factor of about h.
  void add_precise_row(int j, double factor, std::span<const double> c, double* out) const;
  /// out += factor A c
  void add_product(double factor, std::span<const double> c, std::span<double> out) const;

  /// Σ_j |A_ij| for all i.
  std::vector<double> absolute_row_sums() const;

  /// R^T A R for a refinement given by its transpose, one Kronecker product: the Galerkin matrix of the coarser level.
  /// Row sums stay known.
  SymmetricStencil galerkin(const TensorSum& restriction) const;

private:
  template <typename Add>
  void for_terms(int j, std::span<const double> c, Add&& add) const;
  std::vector<double> galerkin_row_sums(const TensorSum& restriction) const;
  std::size_t planes() const { return static_cast<std::size_t>((degree_ + 1) + degree_ * (2 * degree_ + 1)); }
  std::size_t at(int j, int dx, int dy) const {
    const int plane = dy == 0 ? dx : degree_ + 1 + (dy - 1) * (2 * degree_ + 1) + dx + degree_;
    return (static_cast<std::size_t>(j) * planes() + static_cast<std::size_t>(plane)) *
           static_cast<std::size_t>(columns_);
  }

  int rows_ = 0, columns_ = 0, degree_ = 0;
  std::vector<double> values_;    // [row][entry][column]
  std::vector<double> row_sums_;  // none where not known
};

}  // namespace batten
