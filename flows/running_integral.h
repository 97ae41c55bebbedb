// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/interval.h>

#include <functional>
#include <vector>

namespace batten {

/// s ↦ ∫_lower^s f over an interval, to the rounding of ∫ |f|: quadrature [Clenshaw & Curtis 1960] in each cell, cells
/// halved where f is not smooth. A jump of f is found by bisection, so that it need not lie between two cells.
class RunningIntegral {
public:
  using Function = std::function<double(double)>;

  /// Throws InvalidInput if f is not finite.
  RunningIntegral(Function f, const Interval& interval);

  /// s is taken into the interval.
  double operator()(double s) const;
  double total() const { return at_breakpoints_.back(); }
  /// ∫ |f|, as far as one rule for each cell sees it.
  double size() const { return size_; }

private:
  double over(double from, double to) const;

  Function f_;
  Interval interval_;
  double size_ = 0;
  std::vector<double> at_breakpoints_;
};

}  // namespace batten
