// SPDX-License-Identifier: MIT
#include <batten/bases/cell_quadrature.h>

#include <cmath>

namespace batten {
namespace {

double length_of_cell(const Interval& interval, int cell) {
  return interval.coordinate(cell + 1) - interval.coordinate(cell);
}

}  // namespace

CellQuadrature::CellQuadrature(const SplineBasis& basis, int points) : basis_(&basis), rule_(gauss_rule(points)) {
  const auto& interval = basis.interval();
  const auto breakpoints = interval.breakpoints();
  const double unit = interval.finest_cells() / interval.length();
  values_.resize(at(cells(), 0, 0));
  for (int cell = 0; cell < cells(); ++cell)
    for (int q = 0; q < points; ++q)
      for (int order = 0; order < orders; ++order) {
        const auto c = static_cast<std::size_t>(cell);
        const double t =
            breakpoints[c] + rule_.place[static_cast<std::size_t>(q)] * (breakpoints[c + 1] - breakpoints[c]);
        if (order > basis.degree()) continue;  // zero
        const auto local = basis.at(t, order);
        for (int a = 0; a < functions(); ++a)
          values_[at(cell, q, order) + static_cast<std::size_t>(a)] =
              local.values[static_cast<std::size_t>(a)] * std::pow(unit, order);
      }
}

double CellQuadrature::place(int cell, int q) const {
  const auto& interval = basis_->interval();
  return interval.coordinate(cell) + rule_.place[static_cast<std::size_t>(q)] * length_of_cell(interval, cell);
}

double CellQuadrature::weight(int cell, int q) const {
  return rule_.weight[static_cast<std::size_t>(q)] * length_of_cell(basis_->interval(), cell);
}

}  // namespace batten
