// SPDX-License-Identifier: MIT
#include <batten/bases/bell_basis.h>
#include <batten/bases/optimal_mask.h>
#include <batten/bases/polyharmonic_comparison.h>
#include <batten/bases/polyharmonic_scheme.h>
#include <batten/domains/errors.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace batten {
namespace {

struct Masks {
  Mask2<double> laurent;
  std::optional<Mask2<double>> jacobi;
  Mask2<double> least_squares, optimal;
};

bool is_jacobi_size(int order, int size) { return size > 2 * order && (size - 1) % (2 * order) == 0; }

Masks masks_of(int order, int size, const MaskConstraints& constraints) {
  Masks masks{truncated_laurent_mask(order, size), std::nullopt,
              to_double(least_squares_mask(order, size, constraints)),
              to_double(optimal_mask(order, size, constraints).mask)};
  if (is_jacobi_size(order, size)) masks.jacobi = to_double(jacobi_mask(order, {.rounds = jacobi_rounds(order, size)}));
  return masks;
}

template <class Measure>
MaskMethods measured(const Masks& masks, Measure&& measure) {
  MaskMethods result{measure(masks.laurent), std::nullopt, measure(masks.least_squares), measure(masks.optimal)};
  if (masks.jacobi) result.jacobi = measure(*masks.jacobi);
  return result;
}

/// The coefficients of `rounds` rounds at every 2^rounds-th point: p_(r+1)[x] = p_r[x] s[x^(2^r)], of which these are
/// v_(r+1)[j] = Σ_m s[m] v_r[2j - m].
Mask2<double> values_at_integers(const Mask2<double>& s, int rounds) {
  auto v = Mask2<double>::constant(1);
  for (int r = 0; r < rounds; ++r) v = coset(s * v, {0, 0});
  return v;
}

double distance_to_spikes(double x, double y) {
  double nearest = std::hypot(x, y);
  for (int sign : {-1, 1}) nearest = std::min({nearest, std::hypot(x - sign, y), std::hypot(x, y - sign)});
  return nearest;
}

}  // namespace

std::vector<SizeComparison> compare_sizes(int order, std::span<const int> sizes, const MaskConstraints& constraints) {
  std::vector<SizeComparison> table;
  for (int size : sizes)
    table.push_back({size, measured(masks_of(order, size, constraints),
                                    [order](const Mask2<double>& s) { return residual_norm(s, order); })});
  return table;
}

std::vector<RoundsComparison> compare_rounds(int order, int size, int rounds, const MaskConstraints& constraints) {
  const Masks masks = masks_of(order, size, constraints);
  std::vector<RoundsComparison> table;
  for (int k = 1; k <= rounds; ++k)
    table.push_back(
        {k, measured(masks, [order, k](const Mask2<double>& s) { return multilevel_residual(s, order, k); })});
  return table;
}

double limit_error(const Mask2<double>& s, int order, const LimitErrorOptions& options) {
  const int level = options.sample_level;
  if (level < 0 || level > 6 || options.levels < level)
    throw InvalidInput("limit_error: 0 <= sample_level <= 6 and sample_level <= levels are needed, found " +
                       std::to_string(level) + " and " + std::to_string(options.levels));
  const BellBasis bell(order);
  const auto p = iterated(s, level) * values_at_integers(s, options.levels - level);
  const int scale = 1 << level;
  const Index<2> last = p.last();
  double largest = 0;
  for (int j = p.first()[1] - scale; j <= last[1] + scale; ++j)
    for (int i = p.first()[0] - scale; i <= last[0] + scale; ++i) {
      const double x = static_cast<double>(i) / scale, y = static_cast<double>(j) / scale;
      if (order == 1 && distance_to_spikes(x, y) < std::max(options.clearance, 1e-9)) continue;
      largest = std::max(largest, std::abs(p[{i, j}] - bell.value(x, y)));
    }
  return largest;
}

MaskMethods compare_limits(int order, int size, const MaskConstraints& constraints, const LimitErrorOptions& options) {
  return measured(masks_of(order, size, constraints),
                  [&](const Mask2<double>& s) { return limit_error(s, order, options); });
}

}  // namespace batten
