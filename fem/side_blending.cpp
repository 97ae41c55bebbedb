// SPDX-License-Identifier: MIT
#include <batten/fem/side_blending.h>

#include <cstddef>
#include <vector>

namespace batten {
namespace {

/// Along lines of coefficients: entry k is the weight that the polynomial through given ones has for node k at each
/// abscissa.
struct Extension {
  std::vector<int> nodes;
  std::vector<std::vector<double>> weights;

  Extension(const SplineBasis& basis, int first, int last) {
    const int n = basis.size();
    const auto t = basis.greville();
    for (int i = 0; i < first; ++i) nodes.push_back(i);
    for (int i = n - last; i < n; ++i) nodes.push_back(i);
    for (const int k : nodes) {
      auto& weight = weights.emplace_back();
      for (const double place : t) {
        double product = 1;
        for (const int other : nodes) {
          const double node = t[static_cast<std::size_t>(other)];
          if (other != k) product *= (place - node) / (t[static_cast<std::size_t>(k)] - node);
        }
        weight.push_back(product);
      }
    }
  }
};

/// A grid whose lines run along one direction.
struct Lines {
  std::ptrdiff_t count, step, along;  ///< lines, from line to line, from entry to entry
};

std::vector<double> extended(const Extension& extension, const Lines& lines, std::span<const double> c) {
  std::vector<double> result(c.size());
  for (std::size_t k = 0; k < extension.nodes.size(); ++k)
    for (std::ptrdiff_t line = 0; line < lines.count; ++line) {
      const double value = c[static_cast<std::size_t>(line * lines.step + extension.nodes[k] * lines.along)];
      if (value == 0) continue;
      double* out = result.data() + line * lines.step;
      for (const double weight : extension.weights[k]) {
        *out += weight * value;
        out += lines.along;
      }
    }
  return result;
}

}  // namespace

void blend_sides(const SplineBasis& x, const SplineBasis& y, const GivenCoefficients& given, std::span<double> c) {
  const Extension in_x(x, given.left, given.right), in_y(y, given.bottom, given.top);
  const Lines rows{y.size(), x.size(), 1}, columns{x.size(), 1, x.size()};
  const auto over_x = extended(in_x, rows, c), over_y = extended(in_y, columns, c);
  const auto over_both = extended(in_x, rows, over_y);
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = over_x[i] + over_y[i] - over_both[i];
}

}  // namespace batten
