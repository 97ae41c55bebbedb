// SPDX-License-Identifier: MIT
#include <batten/domains/breakpoints.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace batten {

Breakpoints::Breakpoints(std::span<const double> coordinates) {
  if (coordinates.size() < 2)
    throw InvalidInput("Breakpoints: expected at least 2 coordinates, found " + std::to_string(coordinates.size()));
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (!std::isfinite(coordinates[i]))
      throw InvalidInput("Breakpoints: expected finite coordinates, found " + std::to_string(coordinates[i]) +
                         " at index " + std::to_string(i));
    if (i > 0 && !(coordinates[i - 1] < coordinates[i]))
      throw InvalidInput("Breakpoints: expected strictly increasing coordinates, found " +
                         std::to_string(coordinates[i]) + " after " + std::to_string(coordinates[i - 1]) +
                         " at index " + std::to_string(i));
  }
  lower_ = coordinates.front();
  positions_.reserve(coordinates.size());
  for (double x : coordinates) positions_.push_back(x - lower_);
}

Breakpoints Breakpoints::uniform(double lower, double upper, int cells) {
  if (!std::isfinite(lower) || !std::isfinite(upper) || !(lower < upper))
    throw InvalidInput("Breakpoints::uniform: expected finite lower < upper, found " + std::to_string(lower) + " and " +
                       std::to_string(upper));
  if (cells < 1) throw InvalidInput("Breakpoints::uniform: expected at least 1 cell, found " + std::to_string(cells));
  Breakpoints result;
  result.lower_ = lower;
  result.unit_ = (upper - lower) / cells;
  result.positions_.resize(static_cast<std::size_t>(cells) + 1);
  std::iota(result.positions_.begin(), result.positions_.end(), 0.);
  return result;
}

bool Breakpoints::is_uniform() const {
  for (int cell = 1; cell < cells(); ++cell)
    if (width(cell) != width(0)) return false;
  return true;
}

double Breakpoints::width(int cell) const {
  const auto c = static_cast<std::size_t>(cell);
  return positions_[c + 1] - positions_[c];
}

Breakpoints Breakpoints::coarser() const {
  if (!can_coarsen()) throw InvalidInput("Breakpoints::coarser: expected at least 2 cells, found 1");
  Breakpoints result;
  result.lower_ = lower_;
  result.unit_ = unit_;
  for (int i = 0; i <= cells() / 2; ++i)
    result.positions_.push_back(positions_[static_cast<std::size_t>(first_child(i))]);
  return result;
}

int Breakpoints::parent(int cell) const { return std::min(cell / 2, std::max(cells() / 2, 1) - 1); }

int Breakpoints::first_child(int coarse_cell) const { return coarse_cell == cells() / 2 ? cells() : 2 * coarse_cell; }

}  // namespace batten
