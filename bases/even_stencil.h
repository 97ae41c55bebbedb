// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/grid_ranges.h>
#include <batten/bases/tensor_sum.h>

#include <optional>
#include <vector>

namespace batten {

/// The inner rows of a symmetric tensor sum, where they are one stencil, even in both directions:
///
///   out_ij = Σ_pq w_|p||q| in_{i+q, j+p},    |p|, |q| <= reach,
///
/// but for the first and last columns, which have weights of their own. Rows (and columns) at equal distance are added
/// before they are multiplied, and the terms are summed in the weights: half of the work of TensorSum::row and half of
/// its loads. But polynomials that the sum annihilates leave rounding errors here; where those matter, as in residuals
/// of plates, TensorSum::row is the one to take.
class EvenStencil {
public:
  /// None unless the inner rows of `sum` form such a stencil of reach 1 to 5.
  static std::optional<EvenStencil> inside(const TensorSum& sum);

  /// The rows of the result that it holds for.
  RowRange rows() const { return rows_; }

  /// Some columns of row j of the result, j within rows(): in[p] is input row j - reach + p, and out[0] belongs to
  /// column columns.begin.
  void row(const double* const* in, ColumnRange columns, double* out) const;

private:
  EvenStencil() = default;
  void add_weights(const TensorSum& sum);
  void edge_columns(const double* const* in, ColumnRange columns, double* out) const;

  int reach_ = 0;
  RowRange rows_;
  ColumnRange inner_;            // the columns that are not edges
  std::vector<double> weights_;  // [|q|][|p|]
  struct Edge {
    int first;                    // input column of the first weight
    std::vector<double> weights;  // [q][|p|]
  };
  std::vector<Edge> edges_;  // left ones, then right ones
};

}  // namespace batten
