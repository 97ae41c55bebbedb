// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/flows/running_integral.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace batten {
namespace {

struct Rule {
  std::vector<double> place, weight;
};

/// The rule of Clenshaw and Curtis on [0, 1]. It has the ends among its places, so that it sees a jump however near to
/// an end; that of Gauss does not.
Rule clenshaw_curtis() {
  constexpr int n = 16;
  Rule rule;
  for (int k = 0; k <= n; ++k) {
    const double angle = std::numbers::pi * k / n;
    double weight = 1;
    for (int j = 1; j <= n / 2; ++j) weight -= (2 * j == n ? 1 : 2) * std::cos(2 * j * angle) / (4. * j * j - 1);
    rule.place.push_back((1 - std::cos(angle)) / 2);
    rule.weight.push_back((k == 0 || k == n ? 0.5 : 1) * weight / n);
  }
  return rule;
}

const Rule& rule() {
  static const Rule rule = clenshaw_curtis();
  return rule;
}

/// A part of a cell, and its integral by one rule.
struct Piece {
  double from, to;
  double integral = 0, size = 0;  ///< of f and |f|

  Piece(const RunningIntegral::Function& f, double lower, double upper) : from(lower), to(upper) {
    for (std::size_t q = 0; q < rule().place.size(); ++q) {
      const double value = rule().weight[q] * (to - from) * f(from + rule().place[q] * (to - from));
      integral += value;
      size += std::abs(value);
    }
  }
};

}  // namespace

RunningIntegral::RunningIntegral(Function f, const Interval& interval) : f_(std::move(f)), interval_(interval) {
  at_breakpoints_.push_back(0);
  for (int i = 0; i < interval.cells(); ++i) {
    const double from = interval.coordinate(i), to = interval.coordinate(i + 1);
    at_breakpoints_.push_back(at_breakpoints_.back() + over(from, to));
    size_ += Piece(f_, from, to).size;
  }
  if (!std::isfinite(size_)) throw InvalidInput("RunningIntegral: expected a finite function, found one that is not");
}

/// Halved until the halves agree with the whole. A jump takes fifty halvings; more than most_halvings show that f
/// itself has larger errors of rounding.
double RunningIntegral::over(double from, double to) const {
  constexpr int most_halvings = 400;
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  std::vector<Piece> pieces = {Piece(f_, from, to)};
  const double cell = pieces.front().size;
  double sum = 0;
  int halvings = 0;
  while (!pieces.empty()) {
    const Piece whole = pieces.back();
    pieces.pop_back();
    const double middle = whole.from + (whole.to - whole.from) / 2;
    const Piece lower(f_, whole.from, middle), upper(f_, middle, whole.to);
    const double found = lower.integral + upper.integral;
    if (!(std::abs(found - whole.integral) > rounding * (8 * whole.size + cell)) || ++halvings > most_halvings) {
      sum += found;
      continue;
    }
    pieces.push_back(upper);
    pieces.push_back(lower);
  }
  return sum;
}

double RunningIntegral::operator()(double s) const {
  s = std::clamp(s, interval_.lower(), interval_.upper());
  const double t = interval_.to_cells(s);
  const int cell = interval_.cell_of(t);
  const double from = interval_.coordinate(cell);
  const double before = at_breakpoints_[static_cast<std::size_t>(cell)];
  if (s == interval_.upper()) return total();
  return s > from ? before + over(from, s) : before;
}

}  // namespace batten
