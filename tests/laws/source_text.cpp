// SPDX-License-Identifier: MIT
#include <batten/tests/laws/source_text.h>

#include <algorithm>
#include <cctype>
#include <regex>

namespace batten {
namespace {

enum class Kind { Code, Comment, Literal };

struct Piece {
  Kind kind;
  std::size_t end;  ///< one past its last character
};

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::size_t end_or_size(std::string_view text, std::size_t found, std::size_t length) {
  return found == std::string_view::npos ? text.size() : found + length;
}

/// One past a literal that opens at `start` with a quote and in which a backslash escapes the next character.
std::size_t end_of_quoted(std::string_view text, std::size_t start) {
  for (std::size_t i = start + 1; i < text.size(); ++i) {
    if (text[i] == '\\') {
      ++i;
    } else if (text[i] == text[start] || text[i] == '\n') {
      return i + 1;
    }
  }
  return text.size();
}

/// One past a raw string whose opening quote is at `start`.
std::size_t end_of_raw(std::string_view text, std::size_t start) {
  const std::size_t open = text.find('(', start);
  if (open == std::string_view::npos) return text.size();
  const std::string close = ")" + std::string(text.substr(start + 1, open - start - 1)) + "\"";
  return end_or_size(text, text.find(close, open), close.size());
}

bool opens_raw(std::string_view text, std::size_t quote) {
  if (quote == 0 || text[quote - 1] != 'R') return false;
  std::size_t begin = quote - 1;
  while (begin > 0 && is_word(text[begin - 1])) --begin;
  const std::string_view prefix = text.substr(begin, quote - begin);
  return prefix == "R" || prefix == "LR" || prefix == "uR" || prefix == "UR" || prefix == "u8R";
}

/// The comment, literal or single character of code that begins at `start`. The quotes of 1'000'000 are code.
Piece piece_at(std::string_view text, std::size_t start) {
  const std::string_view two = text.substr(start, 2);
  if (two == "//") return {Kind::Comment, end_or_size(text, text.find('\n', start), 0)};
  if (two == "/*") return {Kind::Comment, end_or_size(text, text.find("*/", start + 2), 2)};
  if (text[start] == '"') {
    return {Kind::Literal, opens_raw(text, start) ? end_of_raw(text, start) : end_of_quoted(text, start)};
  }
  const bool separates_digits = start > 0 && std::isxdigit(static_cast<unsigned char>(text[start - 1])) != 0;
  if (text[start] == '\'' && !separates_digits) return {Kind::Literal, end_of_quoted(text, start)};
  return {Kind::Code, start + 1};
}

void blank(std::string& text, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    if (text[i] != '\n') text[i] = ' ';
  }
}

void blank_preprocessor_lines(std::string& code) {
  bool continued = false;
  for (std::size_t begin = 0; begin < code.size();) {
    const std::size_t end = std::min(code.find('\n', begin), code.size());
    const std::size_t first = code.find_first_not_of(" \t", begin);
    const bool directive = continued || (first < end && code[first] == '#');
    continued = directive && end > begin && code[end - 1] == '\\';
    if (directive) blank(code, begin, end);
    begin = end + 1;
  }
}

/// Whether the opening brace after `head`, the code since the last statement or brace, begins a function or a lambda.
/// If not it begins a namespace, a type or a list of values, and functions are looked for inside it.
bool begins_function(const std::string& head, bool inside_parentheses) {
  static const std::regex lambda_tail(R"((\]|\)|\bmutable|\bnoexcept|->[^(,{}]*)\s*$)");
  static const std::regex value_tail(R"(=\s*$)");
  static const std::regex alignment(R"(\balignas\s*\([^()]*\))");
  if (inside_parentheses) return std::regex_search(head, lambda_tail);
  const std::string declaration = std::regex_replace(head, alignment, "");
  const bool has_parameters = declaration.find('(') != std::string::npos;
  return (has_parameters && !std::regex_search(head, value_tail)) || std::regex_search(head, lambda_tail);
}

bool is_access_label(std::string_view head) {
  const std::size_t first = head.find_first_not_of(" \t\n");
  if (first == std::string_view::npos) return false;
  const std::string_view label = head.substr(first);
  return label == "public" || label == "protected" || label == "private";
}

/// Whether a brace that closed at `close` belongs to a constructor's list of initialisers, which its body follows.
bool body_follows(std::string_view code, std::size_t close) {
  const std::size_t next = code.find_first_not_of(" \t\n", close + 1);
  return next != std::string_view::npos && (code[next] == ',' || code[next] == '{');
}

std::size_t matching_brace(const std::string& code, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < code.size(); ++i) {
    if (code[i] == '{') ++depth;
    if (code[i] == '}' && --depth == 0) return i;
  }
  return code.size();
}

int line_of(std::string_view text, std::size_t position) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n'));
}

}  // namespace

SourceText read_source(std::string_view text) {
  SourceText source{std::string(text), std::string(text)};
  for (std::size_t begin = 0; begin < text.size();) {
    const Piece piece = piece_at(text, begin);
    if (piece.kind == Kind::Comment) blank(source.without_comments, begin, piece.end);
    if (piece.kind != Kind::Code) blank(source.code, begin, piece.end);
    begin = piece.end;
  }
  blank_preprocessor_lines(source.code);
  return source;
}

std::vector<Include> includes_of(const SourceText& source) {
  static const std::regex directive(R"((?:^|\n)[ \t]*#[ \t]*include(?:_next)?\b[ \t]*(<[^>\n]*>|"[^"\n]*"|[^\n]*))");
  const std::string& text = source.without_comments;
  std::vector<Include> includes;
  for (std::sregex_iterator match(text.begin(), text.end(), directive); match != std::sregex_iterator(); ++match) {
    includes.push_back({match->str(1), line_of(text, static_cast<std::size_t>(match->position(1)))});
  }
  return includes;
}

std::vector<FunctionExtent> functions_of(const SourceText& source) {
  const std::string& code = source.code;
  std::vector<FunctionExtent> functions;
  std::size_t head = 0;  // where the current declaration begins
  int parentheses = 0;
  for (std::size_t i = 0; i < code.size(); ++i) {
    const char c = code[i];
    if (c == '(') ++parentheses;
    if (c == ')') parentheses = std::max(0, parentheses - 1);
    const bool ends_label = c == ':' && is_access_label(std::string_view(code).substr(head, i - head));
    if (c == '}' || ends_label || (c == ';' && parentheses == 0)) head = i + 1;
    if (c != '{') continue;
    if (!begins_function(code.substr(head, i - head), parentheses > 0)) {
      head = i + 1;
      continue;
    }
    const std::size_t close = matching_brace(code, i);
    const int first = line_of(code, std::min(code.find_first_not_of(" \t\n", head), i));
    functions.push_back({first, line_of(code, std::min(close, code.size() - 1)) - first + 1});
    if (parentheses > 0 || !body_follows(code, close)) head = close + 1;
    i = close;
  }
  return functions;
}

int line_count(std::string_view text) {
  const auto ends = std::count(text.begin(), text.end(), '\n');
  return static_cast<int>(ends) + (!text.empty() && text.back() != '\n' ? 1 : 0);
}

}  // namespace batten
