// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/rectangle.h>

#include <cstddef>
#include <string>

namespace batten {

/// What a spline has: "64 x 32 cells of degree 3 on x 0 to 2, y 0 to 1, 2345 unknowns".
std::string grid_text(const Rectangle& region, int degree, std::size_t unknowns);

}  // namespace batten
