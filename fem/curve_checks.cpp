// SPDX-License-Identifier: MIT
#include <batten/fem/curve_checks.h>

#include <algorithm>
#include <bit>
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

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
double
largest_of_positive(const double* numbers, std::ptrdiff_t count) {
  // Positive doubles are in the order of their bits as whole numbers; negative ones are negative there.
  std::int64_t least = 1, largest = 0;
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const auto bits = std::bit_cast<std::int64_t>(numbers[k]);
    least = std::min(least, bits);
    largest = std::max(largest, bits);
  }
  return least == 1 && largest <= std::bit_cast<std::int64_t>(most) ? std::bit_cast<double>(largest) : 0;
}

}  // namespace batten
