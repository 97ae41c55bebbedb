// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/spline_basis.h>

#include <span>

namespace batten {

/// How many coefficients next to each side are given.
struct GivenCoefficients {
  int left = 0, right = 0, bottom = 0, top = 0;
};

/// Fills a grid of coefficients smoothly from those at its sides, which stay as they are: along each line the
/// polynomial through the given ones, over the Greville abscissae, and of both directions the Boolean sum [Gordon 1971,
/// Coons 1967]. Traces that are smooth so get a lifting that coarse grids can see. `coefficients`: x.size() * y.size(),
/// x fastest, 0 where not given.
void blend_sides(const SplineBasis& x, const SplineBasis& y, const GivenCoefficients& given,
                 std::span<double> coefficients);

}  // namespace batten
