// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask.h>

namespace batten {

// The polyharmonic scheme of order m has the mask s_m[x,y] = 4^(1-m) (l[x²,y²] / l[x,y])^m, the quotient of two
// five-point Laplacians, which is no polynomial [Warren & Weimer 2001, sec. 5.1]. A finite mask s leaves a residual.

/// l[x,y] = x + 1/x + y + 1/y - 4.
Mask2<Rational> five_point_laplacian();

/// r[x,y] = l^m[x,y] s[x,y] - 4^(1-m) l^m[x²,y²], order m >= 1.
template <Coefficient T>
Mask2<T> residual(const Mask2<T>& s, int order);

/// The largest of the arity² sums of |r[i,j]| over indices of the same residues modulo arity: how much the scheme adds
/// to l^m of the data, at most.
template <Coefficient T>
T largest_coset_sum(const Mask2<T>& r, int arity = 2);

/// largest_coset_sum(residual(s, order)).
template <Coefficient T>
T residual_norm(const Mask2<T>& s, int order) {
  return largest_coset_sum(residual(s, order));
}

/// The largest of the 4^k coset sums of |l^m[x,y] ∏_{i<k} s[x^(2^i), y^(2^i)] - 4^(k(1-m)) l^m[x^(2^k), y^(2^k)]|: the
/// residual of k rounds at once [Warren & Weimer 2001, sec. 5.2.4]. rounds >= 0.
double multilevel_residual(const Mask2<double>& s, int order, int rounds);

/// Throws InvalidInput that names the function unless order >= 1.
void require_order(const char* function, int order);

}  // namespace batten
