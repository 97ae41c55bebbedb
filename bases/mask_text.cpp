// SPDX-License-Identifier: MIT
#include <batten/bases/mask_text.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace batten {
namespace {

std::string number_text(double x) {
  std::array<char, 32> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), x).ptr};
}
std::string number_text(const Rational& x) { return x.str(); }

/// `x^-2`, `y^(1/2)`, `x`, or nothing for the power 0.
std::string power_text(char variable, int exponent, int half) {
  const int twice = 2 * exponent + half;
  if (twice == 0) return {};
  std::string text(1, variable);
  if (half) return text + "^(" + std::to_string(twice) + "/2)";
  return exponent == 1 ? text : text + "^" + std::to_string(exponent);
}

template <Coefficient T, int D>
std::string powers_text(const LaurentPolynomial<T, D>& s, std::size_t place) {
  const std::size_t row = static_cast<std::size_t>(s.size()[0]);
  std::string text = power_text('x', s.first()[0] + static_cast<int>(place % row), s.half()[0]);
  if constexpr (D == 2) {
    const auto y = power_text('y', s.first()[1] + static_cast<int>(place / row), s.half()[1]);
    text += (text.empty() || y.empty() ? "" : " ") + y;
  }
  return text;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\n";
  const auto begin = text.find_first_not_of(blank);
  return begin == text.npos ? std::string_view{} : text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t end; (end = text.find(separator)) != text.npos; text.remove_prefix(end + 1))
    parts.push_back(text.substr(0, end));
  parts.push_back(text);
  return parts;
}

[[noreturn]] void refuse_number(std::string_view text) {
  throw InvalidInput("parse_rational: a number such as 3, -1/16 or 0.125 is needed, found '" + std::string(text) + "'");
}

/// Digits with at most one point, at least one digit: d, or d / 10^k.
Rational parse_decimal(std::string_view digits, std::string_view whole) {
  Integer mantissa = 0, scale = 1;
  bool point = false, any = false;
  for (char c : digits) {
    if (c == '.' && !point) {
      point = true;
      continue;
    }
    if (c < '0' || c > '9') refuse_number(whole);
    any = true;
    mantissa = mantissa * 10 + (c - '0');
    if (point) scale *= 10;
  }
  if (!any) refuse_number(whole);
  return Rational(mantissa, scale);
}

/// An exponent of ten within what a person types.
int parse_exponent(std::string_view text, std::string_view whole) {
  int value = 0;
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || std::abs(value) > 400) refuse_number(whole);
  return value;
}

Rational parse_term(std::string_view text, std::string_view whole) {
  const auto e = text.find_first_of("eE");
  Rational value = parse_decimal(text.substr(0, e), whole);
  if (e == text.npos) return value;
  const int exponent = parse_exponent(text.substr(e + 1), whole);
  for (int k = 0; k < std::abs(exponent); ++k) value = exponent < 0 ? Rational(value / 10) : Rational(value * 10);
  return value;
}

std::vector<Rational> parse_row(std::string_view text, const std::string& row) {
  std::vector<Rational> coefficients;
  for (std::string_view part : split(text, ',')) {
    try {
      coefficients.push_back(parse_rational(part));
    } catch (const InvalidInput&) {
      throw InvalidInput("parse_mask: coefficient " + std::to_string(coefficients.size() + 1) + row +
                         " must be a number such as 3, -1/16 or 0.125, found '" + std::string(trimmed(part)) + "'");
    }
  }
  return coefficients;
}

}  // namespace

template <Coefficient T, int D>
std::string to_string(const LaurentPolynomial<T, D>& s) {
  std::string text;
  for (std::size_t k = 0; k < s.coefficients().size(); ++k) {
    const T c = s.coefficients()[k];
    if (c == 0) continue;
    const bool negative = c < 0;
    text += text.empty() ? (negative ? "-" : "") : (negative ? " - " : " + ");
    const T magnitude = negative ? T(-c) : c;
    const std::string powers = powers_text(s, k);
    if (powers.empty() || magnitude != 1) text += number_text(magnitude) + (powers.empty() ? "" : " ");
    text += powers;
  }
  return text.empty() ? "0" : text;
}

Rational parse_rational(std::string_view text) {
  const std::string_view whole = trimmed(text);
  std::string_view rest = whole;
  const bool negative = !rest.empty() && rest.front() == '-';
  if (!rest.empty() && (rest.front() == '-' || rest.front() == '+')) rest.remove_prefix(1);
  const auto slash = rest.find('/');
  Rational value = parse_term(trimmed(rest.substr(0, slash)), whole);
  if (slash != rest.npos) {
    const Rational below = parse_term(trimmed(rest.substr(slash + 1)), whole);
    if (below == 0)
      throw InvalidInput("parse_rational: the denominator must not be 0, found '" + std::string(whole) + "'");
    value /= below;
  }
  return negative ? Rational(-value) : value;
}

Mask<Rational> parse_mask(std::string_view text, int offset) { return {offset, parse_row(text, "")}; }

Mask2<Rational> parse_mask2(std::string_view text, const Index<2>& offset) {
  std::vector<Rational> coefficients;
  int rows = 0;
  std::size_t length = 0;
  for (std::string_view part : split(text, ';')) {
    const auto row = parse_row(part, " of row " + std::to_string(++rows));
    if (rows == 1) length = row.size();
    if (row.size() != length)
      throw InvalidInput("parse_mask2: all rows must have as many coefficients as the first, " +
                         std::to_string(length) + ", found " + std::to_string(row.size()) + " in row " +
                         std::to_string(rows));
    coefficients.insert(coefficients.end(), row.begin(), row.end());
  }
  return {offset, {static_cast<int>(length), rows}, std::move(coefficients)};
}

template std::string to_string(const Mask<Rational>&);
template std::string to_string(const Mask2<Rational>&);
template std::string to_string(const Mask<double>&);
template std::string to_string(const Mask2<double>&);

template <>
std::string index_text<1>(const Index<1>& i) {
  return std::to_string(i[0]);
}

template <>
std::string index_text<2>(const Index<2>& i) {
  std::string text = "(";
  return text.append(std::to_string(i[0])).append(", ").append(std::to_string(i[1])).append(")");
}

}  // namespace batten
