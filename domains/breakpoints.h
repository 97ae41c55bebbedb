// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

namespace batten {

/// An interval cut into cells at any increasing places, and the coarser levels of the same cut.
///
/// Places are held as positions t, coordinate = lower + unit t: whole numbers of cells where the cut is uniform, so
/// that cells of equal shape have equal bits. A coarser level keeps every second breakpoint; where the number of cells
/// is odd, its last cell takes three.
class Breakpoints {
public:
  /// Throws InvalidInput unless there are two or more finite, strictly increasing coordinates; names the first that is
  /// not.
  explicit Breakpoints(std::span<const double> coordinates);
  /// Equal cells. Throws InvalidInput unless lower < upper, both finite, and cells >= 1.
  static Breakpoints uniform(double lower, double upper, int cells);

  int cells() const { return static_cast<int>(positions_.size()) - 1; }
  double lower() const { return lower_; }
  double unit() const { return unit_; }
  /// cells() + 1 increasing numbers, the first 0.
  std::span<const double> positions() const { return positions_; }
  /// Length of a cell in units.
  double width(int cell) const;
  /// Whether all cells have the same length, bit by bit.
  bool is_uniform() const;
  double coordinate(int i) const { return lower_ + unit_ * positions_[static_cast<std::size_t>(i)]; }

  bool can_coarsen() const { return cells() >= 2; }
  /// The next coarser level. Throws InvalidInput if there is only one cell.
  Breakpoints coarser() const;
  /// The cell of coarser() that holds this cell.
  int parent(int cell) const;
  /// The first cell of this level in a cell of coarser(), for 0 .. coarser().cells(), the last being cells().
  int first_child(int coarse_cell) const;

private:
  Breakpoints() = default;
  double lower_ = 0, unit_ = 1;
  std::vector<double> positions_;
};

}  // namespace batten
