// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/matrix_file.h>
#include <batten/io/number_reader.h>
#include <batten/io/row_scanner.h>
#include <batten/io/text_source.h>

#include <string>

namespace batten {
namespace {

std::string at_line(const TextSource& file, std::size_t line) { return file.name() + ": line " + std::to_string(line); }

void append_row(const TextSource& file, const RowScanner& scanner, NumberReader& numbers, NumberMatrix& matrix) {
  const auto fields = scanner.fields();
  const auto count = static_cast<int>(fields.size());
  if (matrix.rows == 0) matrix.columns = count;
  if (count != matrix.columns)
    throw InvalidInput(at_line(file, scanner.line()) + ": the first row has " + std::to_string(matrix.columns) +
                       " numbers, this one has " + std::to_string(count));
  for (int k = 0; k < count; ++k) {
    const auto value = numbers.read(fields[static_cast<std::size_t>(k)]);
    if (!value)
      throw InvalidInput(at_line(file, scanner.line()) + ", column " + std::to_string(k + 1) + ": " +
                         numbers.problem());
    matrix.values.push_back(*value);
  }
  ++matrix.rows;
}

}  // namespace

NumberMatrix read_matrix(const std::filesystem::path& path) {
  const TextSource file(path);
  const std::string_view text = file.utf8_text();
  const Delimiter delimiter = find_delimiter(text);
  RowScanner scanner(text, delimiter);
  NumberReader numbers(delimiter != Delimiter::Comma && text.find(',') != std::string_view::npos);
  NumberMatrix matrix;
  while (scanner.next()) append_row(file, scanner, numbers, matrix);
  if (scanner.unclosed_line() != 0)
    throw InvalidInput(at_line(file, scanner.unclosed_line()) + ": a quotation mark is not closed");
  if (!numbers.ambiguous().empty())
    throw InvalidInput(file.name() + ": " + quoted_excerpt(numbers.ambiguous()) +
                       " may have a decimal comma or a separator of thousands; write the numbers with decimal points");
  if (matrix.rows == 0) throw InvalidInput(file.name() + ": a matrix of numbers is expected, the file is empty");
  return matrix;
}

}  // namespace batten
