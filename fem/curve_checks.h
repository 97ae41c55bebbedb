// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace batten {

// At the speed of the memory, for numbers that are about to be used.

/// Whether knots[0] < knots[1] < ... < knots[cells], all finite and no two further apart than doubles reach.
bool increases(const double* knots, std::ptrdiff_t cells);
bool is_finite(const double* numbers, std::ptrdiff_t count);
/// The largest of numbers that are all positive and finite; 0 where one of them is not.
double largest_of_positive(const double* numbers, std::ptrdiff_t count);

}  // namespace batten
