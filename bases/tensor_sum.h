// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/banded_rows.h>
#include <batten/bases/grid_ranges.h>

#include <span>
#include <vector>

namespace batten {

/// Σ_t factor_t Y_t ⊗ X_t: a sum of Kronecker products of banded matrices, acting on grids of coefficients (x fastest).
///
/// Energies, refinement, restriction and sampling of tensor-product splines all have this form; it is never assembled.
/// All Y_t have the same rows, columns and band, and so have all X_t. At most max_terms terms.
class TensorSum {
public:
  static constexpr int max_terms = 4;
  struct Term {
    double factor = 1;
    BandedRows y, x;
  };

  /// Throws InvalidInput if there is no term, too many, or their shapes differ.
  explicit TensorSum(std::vector<Term> terms);

  int input_columns() const { return terms_.front().x.columns; }
  int input_rows() const { return terms_.front().y.columns; }
  int output_columns() const { return terms_.front().x.rows; }
  int output_rows() const { return terms_.front().y.rows; }
  std::size_t input_size() const { return static_cast<std::size_t>(input_columns()) * input_rows(); }
  std::size_t output_size() const { return static_cast<std::size_t>(output_columns()) * output_rows(); }
  std::span<const Term> terms() const { return terms_; }

  /// Row j of the result for the input grid: writes output_columns() numbers to `out`. Rows of the input whose weights
  /// vanish at the ends of the band are not read. Allocates nothing; one thread.
  void row(int j, const double* in, double* out) const;
  /// The same for some columns of the result, where the rows of the input need not lie one after another: in[q] is
  /// input row first_row(j) + q, and out[0] belongs to column columns.begin.
  void row(int j, const double* const* in, ColumnRange columns, double* out) const;
  /// The first of the band_height() rows of the input that row j of the result takes in.
  int first_row(int j) const { return terms_.front().y.first[static_cast<std::size_t>(j)]; }
  int band_height() const { return terms_.front().y.width; }
  /// out = (this) in; all threads, the same bits for every thread count.
  void apply(std::span<const double> in, std::span<double> out) const;

private:
  std::vector<Term> terms_;
};

}  // namespace batten
