// SPDX-License-Identifier: MIT
#pragma once

namespace batten {

/// Coefficient (i, j) of the polyharmonic mask s_m[x,y] = 4^(1-m) (l[x²,y²] / l[x,y])^m, m = order
/// [Warren & Weimer 2001, sec. 5.1.3]. Far out it falls like r^-4. Relative error about 1e-14 where the coefficient is
/// not much smaller than its neighbours, absolute error below 1e-14 for m = 1, 1e-13 for m = 2 and 3, for all
/// |i|, |j| <= 10^4. Throws InvalidInput when order < 1 or > 8.
double polyharmonic_coefficient(int order, int i, int j);

}  // namespace batten
