// SPDX-License-Identifier: MIT
#include <batten/io/number_reader.h>
#include <batten/io/row_scanner.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace batten {
namespace {

struct Parsed {
  double value = 0;
  std::errc error = {};
};

// The number that is the whole of `text`, with a decimal point; a plus sign may stand in front.
Parsed parse(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Parsed parsed;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, parsed.value);
  parsed.error = stop == end ? error : std::errc::invalid_argument;
  return parsed;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// May the comma of this number separate thousands? Then one to three digits stand before it, no zero first, and exactly
// three behind.
bool may_be_thousands(std::string_view number, std::size_t comma) {
  std::size_t first = 0;
  if (number[0] == '-' || number[0] == '+') first = 1;
  const std::size_t before = comma - first;
  const std::string_view behind = number.substr(comma + 1);
  return before >= 1 && before <= 3 && number[first] != '0' && behind.size() == 3 &&
         std::all_of(behind.begin(), behind.end(), is_digit);
}

}  // namespace

std::optional<double> NumberReader::read(std::string_view field) {
  std::string unquoted;
  if (!field.empty() && field.front() == '"') {
    unquoted = unquote(field);
    field = unquoted;
    while (!field.empty() && field.front() == ' ') field.remove_prefix(1);
    while (!field.empty() && field.back() == ' ') field.remove_suffix(1);
  }
  if (allow_commas_) return read_marked(field);
  const Parsed parsed = parse(field);
  if (parsed.error == std::errc() && std::isfinite(parsed.value)) return parsed.value;
  if (field.empty()) return refuse(field, "the cell is empty, a number is expected");
  if (parsed.error == std::errc::result_out_of_range) return refuse(field, "is out of the range of a double");
  if (parsed.error != std::errc()) return refuse(field, "is not a number");
  return refuse(field, std::isnan(parsed.value) ? "is not finite (NaN)" : "is not finite");
}

// As read, where a comma may be the decimal mark.
std::optional<double> NumberReader::read_marked(std::string_view field) {
  const std::size_t comma = field.find(',');
  const bool has_point = field.find('.') != std::string_view::npos;
  NumberReader plain(false);
  if (comma == std::string_view::npos) {
    const std::optional<double> value = plain.read(field);
    if (!value) problem_ = plain.problem();
    if (!value || !has_point) return value;
    if (mark_ == Mark::Comma) return refuse(field, "has a decimal point, where numbers above have decimal commas");
    mark_ = Mark::Point;
    return value;
  }
  std::string pointed(field);
  pointed[comma] = '.';
  const bool digit_follows = comma + 1 < field.size() && is_digit(field[comma + 1]);
  const std::optional<double> value = has_point || !digit_follows ? std::nullopt : plain.read(pointed);
  if (!value) return refuse(field, "is not a number");
  if (mark_ == Mark::Point) return refuse(field, "has a decimal comma, where numbers above have decimal points");
  mark_ = Mark::Comma;
  if (!may_be_thousands(field, comma)) {
    proven_ = true;
    ambiguous_.clear();
  } else if (!proven_ && ambiguous_.empty()) {
    ambiguous_ = field;
  }
  return value;
}

std::optional<double> NumberReader::refuse(std::string_view field, std::string_view reason) {
  problem_ = field.empty() ? std::string(reason) : quoted_excerpt(field) + ' ' + std::string(reason);
  return std::nullopt;
}

std::string quoted_excerpt(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string excerpt = "'";
  for (const char c : text.substr(0, longest)) excerpt += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  return excerpt + (text.size() > longest ? "...'" : "'");
}

}  // namespace batten
