// SPDX-License-Identifier: MIT
#include <batten/bases/blossom.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

/// Knots of function i of the refined basis between those of its ends, counted in its cells.
std::array<int, SplineBasis::max_degree> inner_knots(int i, int degree, int cells) {
  std::array<int, SplineBasis::max_degree> knots{};
  for (int k = 0; k < degree; ++k) knots[static_cast<std::size_t>(k)] = std::clamp(i + k + 1 - degree, 0, cells);
  return knots;
}

int refined_cells(const SplineBasis& basis, double spacing) {
  return static_cast<int>(std::lround(basis.interval().finest_cells() / spacing));
}

double mean_of(const std::array<int, SplineBasis::max_degree>& knots, int degree) {
  double sum = 0;
  for (int k = 0; k < degree; ++k) sum += knots[static_cast<std::size_t>(k)];
  return sum / degree;
}

}  // namespace

// The blossom of (u - t)^k is the mean of the products of k of the positions, less t.
SplineBasis::Local blossom(const SplineBasis& basis, double t, std::span<const double> positions) {
  const auto n = static_cast<std::size_t>(basis.degree());
  std::array<double, SplineBasis::max_degree + 1> sums = {1}, subsets = {1};
  for (std::size_t i = 1; i <= n; ++i)
    for (std::size_t k = i; k > 0; --k) {
      sums[k] += (positions[i - 1] - t) * sums[k - 1];
      subsets[k] += subsets[k - 1];
    }
  SplineBasis::Local result = basis.at(t);
  double factorial = 1;
  for (std::size_t k = 1; k <= n; ++k) {
    factorial *= static_cast<double>(k);
    const auto derivative = basis.at(t, static_cast<int>(k));
    for (std::size_t j = 0; j <= n; ++j) result.values[j] += derivative.values[j] / factorial * sums[k] / subsets[k];
  }
  return result;
}

SplineBasis::Local refined_coefficient(const SplineBasis& basis, double greville, double spacing) {
  const int d = basis.degree(), cells = refined_cells(basis, spacing);
  const double place = greville / spacing;  // in cells of the refined basis
  int i = std::clamp(static_cast<int>(std::floor(place)), 0, cells + d - 1);
  const auto distance = [&](int k) { return std::abs(mean_of(inner_knots(k, d, cells), d) - place); };
  while (i + 1 < cells + d && distance(i + 1) < distance(i)) ++i;
  const auto knots = inner_knots(i, d, cells);
  std::array<double, SplineBasis::max_degree> positions{};
  for (std::size_t k = 0; k < positions.size(); ++k) positions[k] = spacing * knots[k];
  return blossom(basis, greville, std::span(positions).first(static_cast<std::size_t>(d)));
}

std::vector<double> refined_greville(const SplineBasis& basis, double spacing) {
  const int d = basis.degree(), cells = refined_cells(basis, spacing);
  std::vector<double> result;
  for (int i = 0; i < cells + d; ++i) result.push_back(spacing * mean_of(inner_knots(i, d, cells), d));
  return result;
}

}  // namespace batten
