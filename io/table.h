// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/grid_samples.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace batten {

struct TableOptions {
  /// Columns to read, in the order wanted: a name of the header, or a number counted from 1 (a name that matches wins).
  /// Empty: all columns.
  std::vector<std::string> columns;
  bool skip_invalid = false;  ///< leave out and count the rows that cannot be read, instead of throwing
};

/// Numeric columns of a text file.
struct Table {
  std::vector<std::string> names;            ///< the header's names of the columns read
  std::vector<std::vector<double>> columns;  ///< columns[k][row], finite; as many and in the order of `names`
  std::vector<std::size_t> lines;            ///< the line of the file, counted from 1, where each row begins
  std::size_t skipped = 0;                   ///< rows left out because of `skip_invalid`
};

/// The columns asked for, of a text file whose first line that is not blank names the columns; "-" reads standard
/// input.
///
/// The delimiter (tab, semicolon, comma or a run of blanks) is found from the header and the first rows. Fields may be
/// quoted as in RFC 4180. A byte order mark, carriage returns, blank lines and blanks around a field are ignored, as is
/// a "#" with a blank after it that opens the header. Where the delimiter is not the comma, numbers may have decimal
/// commas, as long as the file leaves no doubt that they are no thousands separators.
/// Throws IoError if the file cannot be read, InvalidInput (naming file, line, column and text) if its content is not
/// such a table, a column is missing or ambiguous, a row has too few or too many fields, a cell that was asked for is
/// empty, no number, NaN or infinite, or no row is left.
Table read_table(const std::filesystem::path& path, const TableOptions& options);

/// Writes columns of equal length under a header of `names`, separated by commas; each number is the shortest text that
/// reads back as the same double, NaN an empty field. Throws IoError; InvalidInput if names and columns do not match.
void write_table(const std::filesystem::path& path, std::span<const std::string> names,
                 std::span<const std::vector<double>> columns);

/// Writes the points of a grid as columns x, y and then the arrays (of an array with several components `name_x`,
/// `name_y`, `name_z`), x running fastest. Throws as above.
void write_table(const std::filesystem::path& path, const GridSamples& grid);

}  // namespace batten
