// SPDX-License-Identifier: MIT
#include <batten/io/row_scanner.h>

#include <algorithm>
#include <array>

namespace batten {
namespace {

constexpr std::size_t none = std::string_view::npos;

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view trim(std::string_view field) {
  while (!field.empty() && (is_blank(field.front()))) field.remove_prefix(1);
  while (!field.empty() && (is_blank(field.back()) || field.back() == '\r')) field.remove_suffix(1);
  return field;
}

// How many of the first rows have as many fields as the header; -1 if the delimiter does not split the header.
int agreeing_rows(std::string_view text, Delimiter delimiter) {
  constexpr int rows_looked_at = 20;
  RowScanner scanner(text, delimiter);
  if (!scanner.next() || scanner.fields().size() < 2) return -1;
  const std::size_t expected = scanner.fields().size();
  int agreeing = 0;
  for (int row = 0; row < rows_looked_at && scanner.next(); ++row) agreeing += scanner.fields().size() == expected;
  return agreeing;
}

}  // namespace

RowScanner::RowScanner(std::string_view text, Delimiter delimiter) : text_(text), delimiter_(delimiter) {}

bool RowScanner::next() {
  while (at_ < text_.size()) {
    row_line_ = line_;
    if (!scan_row()) return false;
    const bool blank = fields_.empty() || (fields_.size() == 1 && fields_[0].empty());
    if (!blank) return true;
  }
  return false;
}

// Reads one line (more if quoted fields span lines) and its end.
bool RowScanner::scan_row() {
  fields_.clear();
  while (true) {
    std::size_t begin = at_;
    while (begin < text_.size() && is_blank(text_[begin]) && text_[begin] != static_cast<char>(delimiter_)) ++begin;
    if (delimiter_ == Delimiter::Blanks) {
      while (begin < text_.size() && is_blank(text_[begin])) ++begin;
    }
    std::size_t end = begin;
    if (begin < text_.size() && text_[begin] == '"') {
      end = closing_quote(begin);
      if (end == none) return false;
    }
    end = scan_plain(end);
    const std::string_view field = trim(text_.substr(begin, end - begin));
    const bool last = end == text_.size() || text_[end] == '\n';
    // Blanks at the end of a line separate nothing.
    if (!(last && field.empty() && delimiter_ == Delimiter::Blanks)) fields_.push_back(field);
    at_ = std::min(end + 1, text_.size());
    if (last) break;
  }
  ++line_;
  return true;
}

// The position behind the quotation mark that closes the one at `open`.
std::size_t RowScanner::closing_quote(std::size_t open) {
  const std::size_t first_line = line_;
  for (std::size_t i = open + 1; i < text_.size(); ++i) {
    if (text_[i] == '\n') ++line_;
    if (text_[i] != '"') continue;
    if (i + 1 == text_.size() || text_[i + 1] != '"') return i + 1;
    ++i;
  }
  unclosed_line_ = first_line;
  at_ = text_.size();
  return none;
}

// The position of the next delimiter or end of line.
std::size_t RowScanner::scan_plain(std::size_t at) const {
  const char* const data = text_.data();
  const std::size_t size = text_.size();
  if (delimiter_ == Delimiter::Blanks) {
    while (at < size && data[at] != '\n' && !is_blank(data[at])) ++at;
  } else {
    const char separator = static_cast<char>(delimiter_);
    while (at < size && data[at] != '\n' && data[at] != separator) ++at;
  }
  return at;
}

Delimiter find_delimiter(std::string_view text) {
  constexpr std::array candidates = {Delimiter::Tab, Delimiter::Semicolon, Delimiter::Comma, Delimiter::Blanks};
  Delimiter best = Delimiter::Comma;
  int most = -1;
  for (const Delimiter candidate : candidates) {
    const int agreeing = agreeing_rows(text, candidate);
    if (agreeing > most) {
      most = agreeing;
      best = candidate;
    }
  }
  return best;
}

std::string unquote(std::string_view field) {
  if (field.size() < 2 || field.front() != '"' || field.back() != '"') return std::string(field);
  std::string text;
  for (std::size_t i = 1; i + 1 < field.size(); ++i) {
    text += field[i];
    if (field[i] == '"') ++i;
  }
  return text;
}

}  // namespace batten
