// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

namespace batten {

/// Numbers in rows and columns.
struct NumberMatrix {
  int rows = 0;
  int columns = 0;
  std::vector<double> values;  ///< row by row
};

/// The numbers of a text file without a header, one row in each line; "-" reads standard input. Delimiters, quotes,
/// blank lines and decimal commas are understood as by read_table. Throws IoError if the file cannot be read,
/// InvalidInput (naming file, line, column and text) if a cell is no finite number, the rows differ in length or there
/// are none.
NumberMatrix read_matrix(const std::filesystem::path& path);

}  // namespace batten
