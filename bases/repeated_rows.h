// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/grid_ranges.h>

#include <cstddef>
#include <vector>

namespace batten {

/// A grid of numbers in which the rows of one range are equal; they are kept once.
class RepeatedRows {
public:
  /// All numbers 0. An empty `repeat` keeps every row.
  RepeatedRows(int rows, int columns, RowRange repeat)
      : repeat_(repeat),
        columns_(columns),
        values_(static_cast<std::size_t>(rows - more()) * static_cast<std::size_t>(columns)) {}

  const double* row(int j) const { return values_.data() + slot(j) * columns_; }
  double* row(int j) { return values_.data() + slot(j) * columns_; }
  int columns() const { return columns_; }
  /// True if row j is kept as another one.
  bool is_repeated(int j) const { return j > repeat_.begin && j < repeat_.end; }
  /// The rows that are kept, one after another.
  std::vector<double>& values() { return values_; }
  const std::vector<double>& values() const { return values_; }

private:
  int more() const { return repeat_.end > repeat_.begin ? repeat_.end - repeat_.begin - 1 : 0; }
  std::ptrdiff_t slot(int j) const { return j <= repeat_.begin ? j : j < repeat_.end ? repeat_.begin : j - more(); }

  RowRange repeat_;
  std::ptrdiff_t columns_;
  std::vector<double> values_;
};

}  // namespace batten
