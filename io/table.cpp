// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/number_reader.h>
#include <batten/io/output_file.h>
#include <batten/io/row_scanner.h>
#include <batten/io/sample_checks.h>
#include <batten/io/table.h>
#include <batten/io/text_source.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <optional>
#include <string_view>

namespace batten {
namespace {

std::string at_line(std::size_t line) { return "line " + std::to_string(line); }

// The text behind the "#" that opens a header like "# x y z".
std::string_view without_opening(std::string_view text) {
  if (text.starts_with("# ") || text.starts_with("#\t")) text.remove_prefix(1);
  return text;
}

std::vector<std::string> header_names(const RowScanner& scanner, const std::string& source) {
  std::vector<std::string> names;
  for (const std::string_view field : scanner.fields()) names.push_back(unquote(field));
  NumberReader numbers(true);
  if (std::all_of(names.begin(), names.end(),
                  [&](const std::string& name) { return numbers.read(name).has_value(); })) {
    throw InvalidInput(source + ": " + at_line(scanner.line()) +
                       " holds numbers only; a header with the names of the columns is expected");
  }
  return names;
}

std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t most = 40;
  std::string list;
  for (std::size_t k = 0; k < std::min(names.size(), most); ++k) list += (k ? ", " : "") + quoted_excerpt(names[k]);
  return names.size() > most ? list + ", ..." : list;
}

// The number of a column, counted from 0, that is asked for by name or by a number counted from 1.
std::size_t find_column(const std::string& asked, const std::vector<std::string>& names, const std::string& source) {
  const auto first = std::find(names.begin(), names.end(), asked);
  if (first != names.end()) {
    const auto second = std::find(first + 1, names.end(), asked);
    if (second == names.end()) return static_cast<std::size_t>(first - names.begin());
    throw InvalidInput(source + ": columns " + std::to_string(first - names.begin() + 1) + " and " +
                       std::to_string(second - names.begin() + 1) + " are both named " + quoted_excerpt(asked) +
                       "; ask for one of them by its number");
  }
  std::size_t number = 0;
  const char* const end = asked.data() + asked.size();
  const auto [stop, error] = std::from_chars(asked.data(), end, number);
  if (error == std::errc() && stop == end && number >= 1 && number <= names.size()) return number - 1;
  throw InvalidInput(source + ": there is no column " + quoted_excerpt(asked) + "; the columns are " + list_of(names));
}

std::vector<std::size_t> chosen_columns(const TableOptions& options, const std::vector<std::string>& names,
                                        const std::string& source) {
  std::vector<std::size_t> chosen(names.size());
  std::iota(chosen.begin(), chosen.end(), 0);
  if (options.columns.empty()) return chosen;
  chosen.clear();
  for (const std::string& asked : options.columns) chosen.push_back(find_column(asked, names, source));
  return chosen;
}

// Reads the chosen cells of rows into columns.
class RowReader {
public:
  RowReader(std::vector<std::size_t> chosen, std::vector<std::string> header, bool allow_decimal_commas)
      : chosen_(std::move(chosen)), header_(std::move(header)), numbers_(allow_decimal_commas), row_(chosen_.size()) {}

  // Appends the row; false, and nothing appended, if it cannot be read.
  bool append(const RowScanner& scanner, Table& table) {
    const std::span<const std::string_view> fields = scanner.fields();
    if (fields.size() != header_.size()) return refuse_count(scanner);
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
      const std::optional<double> value = numbers_.read(fields[chosen_[k]]);
      if (!value) return refuse_cell(scanner, chosen_[k]);
      row_[k] = *value;
    }
    for (std::size_t k = 0; k < row_.size(); ++k) table.columns[k].push_back(row_[k]);
    table.lines.push_back(scanner.line());
    if (ambiguous_line_ == 0 && !numbers_.ambiguous().empty()) ambiguous_line_ = scanner.line();
    return true;
  }

  const std::string& problem() const { return problem_; }

  // What is wrong with the table as a whole; empty if nothing is.
  std::string doubt() const {
    if (numbers_.ambiguous().empty()) return {};
    return at_line(ambiguous_line_) + ": " + quoted_excerpt(numbers_.ambiguous()) +
           " may have a decimal comma or a separator of thousands; write the numbers with decimal points";
  }

private:
  bool refuse_count(const RowScanner& scanner) {
    problem_ = at_line(scanner.line()) + ": the header has " + std::to_string(header_.size()) +
               " fields, this row has " + std::to_string(scanner.fields().size());
    return false;
  }

  bool refuse_cell(const RowScanner& scanner, std::size_t column) {
    problem_ = at_line(scanner.line()) + ", column " + std::to_string(column + 1) + " (" +
               quoted_excerpt(header_[column]) + "): " + numbers_.problem();
    return false;
  }

  std::vector<std::size_t> chosen_;
  std::vector<std::string> header_;
  NumberReader numbers_;
  std::vector<double> row_;
  std::string problem_;
  std::size_t ambiguous_line_ = 0;
};

void read_rows(RowScanner& scanner, RowReader& reader, const std::string& source, const TableOptions& options,
               Table& table) {
  std::string first_problem;
  while (scanner.next()) {
    if (reader.append(scanner, table)) continue;
    if (!options.skip_invalid) throw InvalidInput(source + ": " + reader.problem());
    if (table.skipped++ == 0) first_problem = reader.problem();
  }
  if (scanner.unclosed_line() != 0) {
    throw InvalidInput(source + ": " + at_line(scanner.unclosed_line()) + ": a quotation mark is not closed");
  }
  if (const std::string doubt = reader.doubt(); !doubt.empty()) throw InvalidInput(source + ": " + doubt);
  if (!table.lines.empty()) return;
  if (table.skipped == 0) throw InvalidInput(source + ": there are no rows below the header");
  throw InvalidInput(source + ": none of the rows (" + std::to_string(table.skipped) +
                     ") can be read; the first: " + first_problem);
}

// A name as a field: between quotation marks where a reader would otherwise not get it back.
std::string as_field(const std::string& name) {
  const bool plain =
      name.find_first_of(",;\"\t\r\n") == std::string::npos && !name.starts_with(' ') && !name.ends_with(' ');
  if (plain) return name;
  std::string quoted = "\"";
  for (const char c : name) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

// Appends the shortest text that reads back as `value`; nothing for NaN.
void append_number(std::string& row, double value) {
  constexpr std::size_t longest = 32;
  if (std::isnan(value)) return;
  std::array<char, longest> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + longest, value).ptr;
  row.append(digits.data(), end);
}

std::string header_row(std::span<const std::string> names) {
  std::string row;
  for (const std::string& name : names) row += (row.empty() ? "" : ",") + as_field(name);
  return row + '\n';
}

// Appends the values of all arrays at point `index`.
void append_values(std::string& row, const GridSamples& grid, std::size_t index) {
  for (const PointArray& array : grid.arrays) {
    const auto components = static_cast<std::size_t>(array.components);
    for (std::size_t c = 0; c < components; ++c) {
      row += ',';
      append_number(row, array.values[index * components + c]);
    }
  }
}

std::vector<std::string> grid_names(const GridSamples& grid) {
  std::vector<std::string> names = {"x", "y"};
  for (const PointArray& array : grid.arrays) {
    for (int c = 0; c < array.components; ++c) {
      const std::string suffix = array.components <= 3 ? std::string(1, "xyz"[c]) : std::to_string(c);
      names.push_back(array.components == 1 ? array.name : array.name + '_' + suffix);
    }
  }
  return names;
}

}  // namespace

Table read_table(const std::filesystem::path& path, const TableOptions& options) {
  const TextSource file(path);
  const std::string& source = file.name();
  const std::string_view text = without_opening(file.utf8_text());
  const Delimiter delimiter = find_delimiter(text);
  RowScanner scanner(text, delimiter);
  if (!scanner.next() && scanner.unclosed_line() == 0) throw InvalidInput(source + ": the file is empty");
  const std::vector<std::string> names = header_names(scanner, source);
  const std::vector<std::size_t> chosen = chosen_columns(options, names, source);

  Table table;
  table.columns.resize(chosen.size());
  for (const std::size_t k : chosen) table.names.push_back(names[k]);
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  for (std::vector<double>& column : table.columns) column.reserve(lines);
  table.lines.reserve(lines);
  const bool decimal_commas = delimiter != Delimiter::Comma && text.find(',') != std::string_view::npos;
  RowReader reader(chosen, names, decimal_commas);
  read_rows(scanner, reader, source, options, table);
  return table;
}

void write_table(const std::filesystem::path& path, std::span<const std::string> names,
                 std::span<const std::vector<double>> columns) {
  const std::size_t rows = columns.empty() ? 0 : columns[0].size();
  const bool equal =
      std::all_of(columns.begin(), columns.end(), [&](const auto& column) { return column.size() == rows; });
  if (names.size() != columns.size() || !equal) {
    throw InvalidInput("write_table: one name for each column and columns of equal length are expected");
  }
  OutputFile file(path);
  std::string row = header_row(names);
  file.write(row);
  for (std::size_t i = 0; i < rows; ++i) {
    row.clear();
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (k > 0) row += ',';
      append_number(row, columns[k][i]);
    }
    row += '\n';
    file.write(row);
  }
  file.commit();
}

void write_table(const std::filesystem::path& path, const GridSamples& grid) {
  check_arrays(grid, "write_table");
  OutputFile file(path);
  std::string row = header_row(grid_names(grid));
  file.write(row);
  const auto nx = static_cast<std::size_t>(grid.points[0]);
  const std::size_t count = nx * static_cast<std::size_t>(grid.points[1]);
  for (std::size_t index = 0; index < count; ++index) {
    const std::size_t i = index % nx, j = index / nx;
    row.clear();
    append_number(row, grid.origin[0] + static_cast<double>(i) * grid.spacing[0]);
    row += ',';
    append_number(row, grid.origin[1] + static_cast<double>(j) * grid.spacing[1]);
    append_values(row, grid, index);
    row += '\n';
    file.write(row);
  }
  file.commit();
}

}  // namespace batten
