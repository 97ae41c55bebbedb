// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/rectangle.h>
#include <batten/fem/boundary_problem.h>

#include <filesystem>
#include <string>

namespace batten {

/// A field given by a table.
struct TableField {
  Field field;         ///< NaN where the table does not reach
  std::string extent;  ///< where it reaches: "x from 0 to 1, y from 0 to 2"
};

/// The field of a text file with the columns x, y and value, in any order of the rows.
///
/// If the points form a full grid of at least 2 x 2 (every x with every y, once), the field is bilinear between them
/// and ends with them. Any other points are fitted as `batten fit` does, by the thin plate whose smoothing
/// cross-validation chooses: on the box around `region` and the points, with square cells whose length is half the mean
/// distance of points, but 8 to 256 cells on the longer side; such a field reaches everywhere in `region`.
/// Throws IoError, InvalidInput with the line and column of the table.
TableField field_of_table(const std::filesystem::path& file, const Rectangle& region);

}  // namespace batten
