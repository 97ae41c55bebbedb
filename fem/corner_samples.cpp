// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/corner_samples.h>

#include <algorithm>
#include <limits>
#include <string>

namespace batten {
namespace {

/// Values of the functions at the breakpoints.
Eigen::SparseMatrix<double> values_at_breakpoints(const KnotSplines& basis) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i <= basis.cells(); ++i) {
    const int cell = std::min(i, basis.cells() - 1);
    const auto local = basis.at(cell, i == cell ? 0 : basis.breakpoints().width(cell));
    for (int a = 0; a <= basis.degree(); ++a)
      if (local[a] != 0) entries.emplace_back(i, cell + a, local[a]);
  }
  Eigen::SparseMatrix<double> values(basis.cells() + 1, basis.size());
  values.setFromTriplets(entries.begin(), entries.end());
  return values;
}

/// Blanks the corners that belong to no cell of the domain.
void blank_outside(const SplineLevel& level, Eigen::MatrixXd& values) {
  const auto is_inside = [&](int cx, int cy) {
    return cx >= 0 && cy >= 0 && cx < level.x().cells() && cy < level.y().cells() && level.is_inside(cx, cy);
  };
  for (int j = 0; j <= level.y().cells(); ++j)
    for (int i = 0; i <= level.x().cells(); ++i)
      if (!is_inside(i - 1, j - 1) && !is_inside(i, j - 1) && !is_inside(i - 1, j) && !is_inside(i, j))
        values(i, j) = std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

GridSamples corner_samples(const SplineLevel& level, const Eigen::VectorXd& coefficients) {
  const Breakpoints &x = level.x().breakpoints(), &y = level.y().breakpoints();
  if (level.is_interval() || !x.is_uniform() || !y.is_uniform())
    throw InvalidInput("corner_samples: a rectangle of equal cells is expected, found one that is not");
  if (coefficients.size() != level.size())
    throw InvalidInput("corner_samples: the level has " + std::to_string(level.size()) + " coefficients, found " +
                       std::to_string(coefficients.size()));
  Eigen::MatrixXd grid = Eigen::MatrixXd::Zero(level.x().size(), level.y().size());
  for (int f = 0; f < level.size(); ++f) grid.data()[level.grid(f)] = coefficients[f];
  Eigen::MatrixXd values = values_at_breakpoints(level.x()) * grid * values_at_breakpoints(level.y()).transpose();
  if (level.has_mask()) blank_outside(level, values);
  GridSamples samples{.points = {static_cast<int>(values.rows()), static_cast<int>(values.cols())}};
  samples.origin = {x.lower(), y.lower()};
  samples.spacing = {x.unit() * x.width(0), y.unit() * y.width(0)};
  samples.arrays = {{"value", 1, {values.data(), values.data() + values.size()}}};
  return samples;
}

}  // namespace batten
