// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace batten {

/// A text that is no expression.
class ExpressionError : public std::runtime_error {
public:
  ExpressionError(const std::string& text, std::size_t position) : std::runtime_error(text), position_(position) {}
  /// The character where it is wrong, from 0; at most the length of the text.
  std::size_t position() const { return position_; }

private:
  std::size_t position_;
};

/// A formula in x and y, in muParser's language: + - * / ^, comparisons, && and ||, a ? b : c, the constants pi and e,
/// and the functions sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp ln log log2 log10 sqrt abs
/// sign rint floor ceil mod min max sum avg. `log` is the natural logarithm, mod(a, b) has the sign of b.
class Expression {
public:
  /// Throws ExpressionError.
  explicit Expression(std::string text);

  const std::string& text() const { return text_; }
  /// Neither x nor y is in it.
  bool is_constant() const { return is_constant_; }
  /// NaN and infinity where the formula gives them. May be called by several threads at once: each has a parser of its
  /// own, made when it first comes here.
  double operator()(double x, double y) const;

private:
  std::string text_;
  std::size_t number_;  ///< no other expression made in this process has it
  bool is_constant_ = false;
};

}  // namespace batten
