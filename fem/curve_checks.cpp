// SPDX-License-Identifier: MIT
#include <batten/fem/curve_checks.h>

#include <cmath>
#include <cstdint>
#include <limits>

// Kernels are compiled for the instruction sets of the x86-64 levels and chosen at start; other processors get the
// plain ones. Counts, as wide as the numbers, are what vectors of them can hold.

namespace batten {
namespace {

constexpr double most = std::numeric_limits<double>::max();

}  // namespace

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
bool increases(const double* knots, std::ptrdiff_t cells) {
  std::int64_t good = 0;
  for (std::ptrdiff_t k = 0; k < cells; ++k) {
    const double width = knots[k + 1] - knots[k];
    good += std::int64_t{width > 0} + std::int64_t{width <= most};
  }
  return good == 2 * cells;
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
bool is_finite(const double* numbers, std::ptrdiff_t count) {
  std::int64_t good = 0;
  for (std::ptrdiff_t k = 0; k < count; ++k) good += std::int64_t{std::abs(numbers[k]) <= most};
  return good == count;
}

}  // namespace batten
