// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

namespace batten {

/// An interval [lower, upper] cut into cells, and the coarser levels of the same cut.
///
/// Breakpoints are counted in cells of the finest level, so they are integers on every level. The finest level is
/// uniform. A coarser level keeps every second breakpoint; where the number of cells is odd, the last cell takes the
/// remainder and is less than twice as long as the others. Any number of cells therefore has a nested hierarchy.
class Interval {
public:
  /// Throws InvalidInput unless lower < upper (both finite) and cells >= 1.
  Interval(double lower, double upper, int cells);

  double lower() const { return lower_; }
  double upper() const { return upper_; }
  double length() const { return upper_ - lower_; }

  int cells() const { return static_cast<int>(breakpoints_.size()) - 1; }
  int finest_cells() const { return breakpoints_.back(); }
  /// Positions of the cells() + 1 breakpoints in cells of the finest level, from 0 to finest_cells().
  std::span<const int> breakpoints() const { return breakpoints_; }
  /// Length of every cell but the last, in cells of the finest level.
  int regular_cell() const { return cells() > 1 ? breakpoints_[1] : breakpoints_.back(); }

  /// True if the last cell is as long as the others.
  bool is_uniform() const { return finest_cells() == cells() * regular_cell(); }
  /// Length of the cells of the finest level, in the unit of lower() and upper().
  double finest_cell_length() const { return length() / finest_cells(); }

  /// The cell that holds position t (in cells of the finest level); the ends belong to the first and the last cell.
  int cell_of(double t) const;
  /// Position of coordinate x in cells of the finest level; within [0, finest_cells()] for x within [lower, upper].
  double to_cells(double x) const;
  /// Coordinate of breakpoint i; exactly lower and upper at the ends.
  double coordinate(int i) const;

  bool can_coarsen() const { return cells() >= 2; }
  /// The next coarser level. Throws InvalidInput if there is only one cell.
  Interval coarser() const;

private:
  double lower_, upper_;
  std::vector<int> breakpoints_;
};

}  // namespace batten
