// SPDX-License-Identifier: MIT
#pragma once

namespace batten {

/// Rows begin .. end - 1 of a grid.
struct RowRange {
  int begin = 0, end = 0;
};

/// Columns begin .. end - 1 of a grid.
struct ColumnRange {
  int begin = 0, end = 0;
};

}  // namespace batten
