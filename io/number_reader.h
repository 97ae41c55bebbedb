// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace batten {

/// Reads the numbers of one table, which agree on their decimal mark.
///
/// Points are always understood. Commas are if allowed and no number with a point came before; since "1,234" may also
/// mean 1234, `ambiguous` tells whether nothing in the table has ruled that out.
class NumberReader {
public:
  explicit NumberReader(bool allow_decimal_commas) : allow_commas_(allow_decimal_commas) {}

  /// The finite number that `field` (perhaps quoted) holds; nothing if it holds none, and then `problem` says why.
  std::optional<double> read(std::string_view field);

  /// What is wrong with the field read last: "'abc' is not a number".
  const std::string& problem() const { return problem_; }

  /// The first number with a comma, if every comma of the table might separate thousands; else empty.
  const std::string& ambiguous() const { return ambiguous_; }

private:
  enum class Mark { Unknown, Point, Comma };
  std::optional<double> read_marked(std::string_view field);
  std::optional<double> refuse(std::string_view field, std::string_view reason);

  bool allow_commas_;
  Mark mark_ = Mark::Unknown;
  bool proven_ = false;  // a comma was seen that cannot separate thousands
  std::string ambiguous_;
  std::string problem_;
};

/// `text` between quotation marks, on one line and not longer than fits into a message.
std::string quoted_excerpt(std::string_view text);

}  // namespace batten
