// SPDX-License-Identifier: MIT
#include <batten/fem/cubic_refinement.h>

#include <algorithm>
#include <span>

namespace batten {
namespace {

constexpr int nodes = 4;

/// Row i: the Lagrange polynomials of the four coarse nodes around fine node i, at that node. Zero where a condition
/// takes the node's function away.
BandedRows cubic_rows(const SplineBasis& coarse, const SplineBasis& fine) {
  const std::span<const int> at = coarse.interval().breakpoints(), to = fine.interval().breakpoints();
  BandedRows result;
  result.rows = fine.size();
  result.columns = coarse.size();
  result.width = nodes;
  result.period = 2;
  result.shift = 1;
  for (int i = 0; i < fine.size(); ++i) {
    const int t = to[static_cast<std::size_t>(i)];
    const auto cell = static_cast<int>(std::upper_bound(at.begin(), at.end(), t) - at.begin()) - 1;
    const int first = std::clamp(cell - 1, 0, coarse.size() - nodes);
    result.first.push_back(first);
    for (int k = 0; k < nodes; ++k) {
      double weight = fine.is_removed(i) ? 0 : 1;
      for (int m = 0; m < nodes; ++m) {
        const double other = at[static_cast<std::size_t>(first + m)];
        if (m != k) weight *= (t - other) / (at[static_cast<std::size_t>(first + k)] - other);
      }
      result.weights.push_back(weight);
    }
  }
  find_repeating_rows(result);
  return result;
}

}  // namespace

std::optional<TensorSum> cubic_refinement(const Hierarchy& hierarchy, int level) {
  if (hierarchy.degree() > 1 || level + 1 >= hierarchy.size()) return {};
  const auto& fine = hierarchy[level].space;
  const auto& coarse = hierarchy[level + 1].space;
  if (coarse.x.size() < nodes || coarse.y.size() < nodes) return {};
  const auto rows = [](const SplineBasis& c, const SplineBasis& f) {
    return c.size() == f.size() ? identity_rows(f.size()) : cubic_rows(c, f);
  };
  return TensorSum({{1., rows(coarse.y, fine.y), rows(coarse.x, fine.x)}});
}

}  // namespace batten
