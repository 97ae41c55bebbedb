// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/polyharmonic_residual.h>

namespace batten {

// Finite masks in place of the polyharmonic s_m = 4^(1-m) (l[x²,y²] / l[x,y])^m [Warren & Weimer 2001, sec. 5.2]. All
// throw InvalidInput when the order is below 1, or the size even or below 3. Masks are centred on 0. Those that are
// best in a norm of the residual are in optimal_mask.h.

/// The coefficients |i|, |j| <= (size - 1) / 2 of the Laurent series [ibid., sec. 5.2.1]. They do not sum to 4, nor do
/// the cosets to 1.
Mask2<double> truncated_laurent_mask(int order, int size);

/// The mask with each coset divided by its sum, so that constants are reproduced; exact for the doubles given. Throws
/// InvalidInput when a coset sums to 0.
Mask2<Rational> with_unit_cosets(const Mask2<double>& s);

struct JacobiOptions {
  /// Jacobi's a. Rounds converge for a in (0, 2 / 8^m); 0 stands for 1 / 8^m.
  Rational relaxation = 0;
  int rounds = 3;
};

/// s^i = s^(i-1) - a (-1)^m (l^m s^(i-1) - 4^(1-m) l^m[x²,y²]), for m = 1 (a l + 1) s^(i-1) - a l[x²,y²], from the
/// B-spline of order 2m in each direction, for m = 1 (1+x)² (1+y)² / (4 x y) [ibid., sec. 5.2.2]. The size is
/// 2m (rounds + 1) + 1. Every one has zeros of order 2m at (-1,1), (1,-1), (-1,-1) and the sum 4.
Mask2<Rational> jacobi_mask(int order, const JacobiOptions& options = {});
/// The rounds that give a mask of this size. Throws InvalidInput that names the sizes next to it when there are none.
int jacobi_rounds(int order, int size);

}  // namespace batten
