// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/fem/energy_levels.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace batten {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

Sparse second_differences(int size) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i + 2 < size; ++i) {
    entries.emplace_back(i, i, 1.);
    entries.emplace_back(i, i + 1, -2.);
    entries.emplace_back(i, i + 2, 1.);
  }
  Sparse d(size - 2, size);
  d.setFromTriplets(entries.begin(), entries.end());
  return d;
}

Sparse every_second(int size) {
  Sparse m(size, 2 * size - 1);
  for (int i = 0; i < size; ++i) m.insert(i, 2 * i) = 1;
  return m;
}

}  // namespace

std::vector<SplineLevel> spline_levels(const VariationalDomain& domain, int steps) {
  if (steps < 0) throw InvalidInput("spline_levels: expected at least 0 steps, found " + std::to_string(steps));
  std::vector<SplineLevel> result = {SplineLevel(domain)};
  for (int k = 0; k < steps; ++k) {
    if (!result.back().can_coarsen())
      throw InvalidInput("spline_levels: expected cells for " + std::to_string(steps) + " coarsenings, found " +
                         std::to_string(domain.x.cells()) + " x " + std::to_string(domain.rows()) +
                         " cells, enough for " + std::to_string(k));
    result.push_back(result.back().coarser());
  }
  std::reverse(result.begin(), result.end());
  return result;
}

EnergyLevels energy_levels(const std::vector<SplineLevel>& levels) {
  if (levels.empty()) throw InvalidInput("energy_levels: expected at least one level, found none");
  EnergyLevels result;
  for (const SplineLevel& level : levels) result.levels.push_back({level.energy(), level.null_space(), {}});
  for (std::size_t k = 0; k + 1 < levels.size(); ++k)
    result.steps.push_back({levels[k].refinement(levels[k + 1]),
                            measurement_matrix(levels[k], levels[k + 1], Measurement::GrevilleValues).M});
  for (std::size_t k = levels.size(); k-- > 0;) {
    const bool whole = k + 1 == levels.size() || !levels[k].has_mask();
    result.levels[k].weights = whole ? levels[k].moments() : result.levels[k + 1].weights * result.steps[k].R;
  }
  return result;
}

EnergyLevels natural_cubic_levels(int cells, int steps) {
  if (cells < 2 || steps < 0)
    throw InvalidInput("natural_cubic_levels: expected at least 2 cells and 0 steps, found " + std::to_string(cells) +
                       " and " + std::to_string(steps));
  EnergyLevels result;
  int size = cells + 1;
  for (int k = 0; k <= steps; ++k, size = 2 * size - 1) {
    const Sparse d = second_differences(size);
    Eigen::MatrixXd z(size, 2);
    z.col(0).setOnes();
    z.col(1).setLinSpaced(-1, 1);
    const Sparse square = d.transpose() * d;
    result.levels.push_back({std::pow(8., k) * square, z, Eigen::MatrixXd(0, size)});
    if (k < steps) result.steps.push_back({{}, every_second(size)});
  }
  return result;
}

}  // namespace batten
