// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/gauss_rule.h>
#include <batten/bases/spline_basis.h>

#include <array>
#include <vector>

namespace batten {

/// Gauss points in the cells of one direction, with the basis functions there. Coordinates are those of the interval.
class CellQuadrature {
public:
  static constexpr int orders = 3;  ///< derivatives of order 0, 1, 2 with respect to the coordinate

  /// `points` Gauss points in each cell.
  CellQuadrature(const SplineBasis& basis, int points);

  int points() const { return static_cast<int>(rule_.place.size()); }
  int cells() const { return basis_->interval().cells(); }
  int functions() const { return basis_->degree() + 1; }
  double place(int cell, int q) const;
  double weight(int cell, int q) const;  ///< Gauss weight times the length of the cell
  /// Value or derivative of function cell + a.
  double value(int cell, int q, int order, int a) const {
    return values_[at(cell, q, order) + static_cast<std::size_t>(a)];
  }
  const double* values(int cell, int q, int order) const { return values_.data() + at(cell, q, order); }

private:
  std::size_t at(int cell, int q, int order) const {
    return static_cast<std::size_t>(((cell * points() + q) * orders + order) * functions());
  }

  const SplineBasis* basis_;
  GaussRule rule_;
  std::vector<double> values_;
};

}  // namespace batten
