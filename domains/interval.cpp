// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/interval.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace batten {

Interval::Interval(double lower, double upper, int cells) : lower_(lower), upper_(upper) {
  if (!std::isfinite(lower) || !std::isfinite(upper) || !(lower < upper))
    throw InvalidInput("Interval: expected finite lower < upper, found " + std::to_string(lower) + " and " +
                       std::to_string(upper));
  if (cells < 1) throw InvalidInput("Interval: expected at least 1 cell, found " + std::to_string(cells));
  breakpoints_.resize(static_cast<std::size_t>(cells) + 1);
  std::iota(breakpoints_.begin(), breakpoints_.end(), 0);
}

int Interval::cell_of(double t) const {
  const int cell = static_cast<int>(t / regular_cell());
  return std::clamp(cell, 0, cells() - 1);
}

double Interval::to_cells(double x) const { return (x - lower_) / (upper_ - lower_) * finest_cells(); }

double Interval::coordinate(int i) const {
  if (i == cells()) return upper_;
  return lower_ + (upper_ - lower_) * (static_cast<double>(breakpoints_[static_cast<std::size_t>(i)]) / finest_cells());
}

Interval Interval::coarser() const {
  if (!can_coarsen()) throw InvalidInput("Interval::coarser: expected at least 2 cells, found 1");
  Interval result = *this;
  const int coarse_cells = cells() / 2;
  for (int i = 0; i < coarse_cells; ++i)
    result.breakpoints_[static_cast<std::size_t>(i)] = breakpoints_[static_cast<std::size_t>(2 * i)];
  result.breakpoints_[static_cast<std::size_t>(coarse_cells)] = breakpoints_.back();
  result.breakpoints_.resize(static_cast<std::size_t>(coarse_cells) + 1);
  return result;
}

}  // namespace batten
