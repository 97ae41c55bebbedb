// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/grid_ranges.h>
#include <batten/bases/tensor_sum.h>

namespace batten {

// Rows of refinement and restriction for BilinearSmoother, fast where columns are halved. Rows in rings are as
// bilinear_rows.h says.

/// True if columns are refined two by two.
bool halves_columns(const TensorSum& refinement);

/// What is refined.
struct CoarseRows {
  const TensorSum& refinement;
  const double* coarse;
};
/// A row that is added, where its column 0 would be, or null; whether whole lines of it can be read.
struct AddedRow {
  const double* row;
  bool has_more_behind;
};
/// The columns of row j of the refined coarse values in `row`, a ring's, where its column 0 would be.
void refine_columns(const CoarseRows& from, int j, ColumnRange columns, const AddedRow& added, double* row);

/// The rows of a band of residuals, in rings, where their column 0 would be; columns from `begin` on are there.
struct ResidualRows {
  const double* const* rows;
  int begin;
};
/// The coarse columns of row k of the restricted residual in `out`, where its column 0 would be.
void restrict_columns(const TensorSum& restriction, int k, const ResidualRows& from, ColumnRange coarse, double* out);

}  // namespace batten
