// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace batten {

/// What separates the fields of a row; Blanks is any run of spaces and tabs.
enum class Delimiter : char { Tab = '\t', Semicolon = ';', Comma = ',', Blanks = ' ' };

/// Walks through the rows of a delimited text once, without copying it.
///
/// Lines end with "\n" or "\r\n". A field whose first character is a quotation mark reaches to the closing one and may
/// contain delimiters, ends of lines and doubled quotation marks. Lines of blanks alone are no rows.
class RowScanner {
public:
  RowScanner(std::string_view text, Delimiter delimiter);

  /// Goes to the next row. False at the end of the text, or if a quotation mark is not closed.
  bool next();

  /// The fields of the row without the blanks around them, quoted ones with their quotation marks.
  /// Valid until the next call of `next`.
  std::span<const std::string_view> fields() const { return fields_; }

  /// The line, counted from 1, where the row begins.
  std::size_t line() const { return row_line_; }

  /// The line of a quotation mark that is not closed, 0 if there is none so far.
  std::size_t unclosed_line() const { return unclosed_line_; }

private:
  bool scan_row();
  std::size_t closing_quote(std::size_t open);
  std::size_t scan_plain(std::size_t at) const;

  std::string_view text_;
  Delimiter delimiter_;
  std::size_t at_ = 0;    // the next character
  std::size_t line_ = 1;  // its line
  std::size_t row_line_ = 0;
  std::size_t unclosed_line_ = 0;
  std::vector<std::string_view> fields_;
};

/// The delimiter of a text with a header: of those that split the header, the one under which most of the first rows
/// have as many fields as the header; Comma if nothing splits the header.
Delimiter find_delimiter(std::string_view text);

/// A field without its quotation marks, doubled ones made single.
std::string unquote(std::string_view field);

}  // namespace batten
