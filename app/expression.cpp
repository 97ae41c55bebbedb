// SPDX-License-Identifier: MIT
#include <batten/app/expression.h>

#include <muParser.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace batten {
namespace {

double modulo(double a, double b) { return a - b * std::floor(a / b); }
double round_down(double v) { return std::floor(v); }
double round_up(double v) { return std::ceil(v); }

/// A parser and the variables that it reads: for one thread.
class Evaluator {
public:
  explicit Evaluator(const std::string& text) {
    parser_.DefineVar("x", &x_);
    parser_.DefineVar("y", &y_);
    parser_.DefineConst("pi", std::numbers::pi);
    parser_.DefineConst("e", std::numbers::e);
    parser_.DefineFun("floor", round_down);
    parser_.DefineFun("ceil", round_up);
    parser_.DefineFun("mod", modulo);
    parser_.SetExpr(text);
  }

  double at(double x, double y) {
    x_ = x;
    y_ = y;
    return parser_.Eval();
  }
  bool is_constant() const { return parser_.GetUsedVar().empty(); }
  int results() const { return parser_.GetNumResults(); }

private:
  double x_ = 0, y_ = 0;
  mu::Parser parser_;
};

std::string trimmed(const std::string& text) { return text.substr(0, text.find_last_not_of(" \t\n") + 1); }

std::string reason_of(const mu::ParserError& error) {
  const std::string token = trimmed(error.GetToken());
  switch (error.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN:
      return "'" + token + "' is not known (x, y, pi, e and functions are)";
    case mu::ecUNEXPECTED_EOF:
      return "it ends too early";
    case mu::ecMISSING_PARENS:
      return "a parenthesis is missing";
    case mu::ecTOO_FEW_PARAMS:
      return "'" + token + "' needs more arguments";
    case mu::ecTOO_MANY_PARAMS:
      return "'" + token + "' has too many arguments";
    case mu::ecEMPTY_EXPRESSION:
      return "it is empty";
    default:
      return token.empty() ? error.GetMsg() : "'" + token + "' is not expected there";
  }
}

/// The place of an "=" that would set a variable; the end if there is none.
std::size_t assignment_in(const std::string& text) {
  for (std::size_t i = text.find('='); i < text.size(); i = text.find('=', i + 1)) {
    const bool is_pair = i + 1 < text.size() && text[i + 1] == '=';
    const bool ends_sign = i > 0 && (text[i - 1] == '<' || text[i - 1] == '>' || text[i - 1] == '!');
    if (!is_pair && !ends_sign) return i;
    if (is_pair) ++i;
  }
  return text.size();
}

std::size_t next_number() {
  static std::atomic<std::size_t> made = 0;
  return made++;
}

}  // namespace

Expression::Expression(std::string text) : text_(std::move(text)), number_(next_number()) {
  if (const std::size_t at = assignment_in(text_); at < text_.size())
    throw ExpressionError("'=' is not expected there (equality is ==)", at);
  try {
    Evaluator evaluator(text_);
    evaluator.at(0, 0);
    is_constant_ = evaluator.is_constant();
    if (evaluator.results() != 1) throw ExpressionError("one value is expected, found several", 0);
  } catch (const mu::ParserError& error) {
    const int at = std::clamp(error.GetPos(), 0, static_cast<int>(text_.size()));
    throw ExpressionError(reason_of(error), static_cast<std::size_t>(at));
  }
}

double Expression::operator()(double x, double y) const {
  thread_local std::vector<std::unique_ptr<Evaluator>> evaluators;  // by the number of the expression
  if (evaluators.size() <= number_) evaluators.resize(number_ + 1);
  auto& evaluator = evaluators[number_];
  if (!evaluator) evaluator = std::make_unique<Evaluator>(text_);
  return evaluator->at(x, y);
}

}  // namespace batten
