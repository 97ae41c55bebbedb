// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/scheme.h>

namespace batten {

// Exponential B-splines: the scaling functions n of the operator ∏_i (d/dx - a_i), piecewise in its null space, with
// support [0, m], C^(m-2) and integral 1 [Warren & Weimer 2001, sec. 4.3]. The roots a_i are real or come in conjugate
// pairs; all roots 0 give the B-spline of order m. Coefficient i of level k belongs to i / 2^k. Throws InvalidInput
// unless there are 1 to 32 roots, finite, conjugates paired to 1e-12 of their size, |Re a| <= 700 and |Im a| < 2 π.

using Roots = std::vector<std::complex<double>>;

/// s_k[x] = 2 ∏ (1 + η_i x) / (1 + η_i), η_i = exp(a_i / 2^k): the mask of the step to level k. Its coefficients sum
/// to 2.
Scheme exponential_scheme(const Roots& roots);

/// d_k[x] = ∏ a_i / (η_i - 1) (1 - η_i x), η_i = exp(a_i / 2^k), each factor 2^k (1 - x) for a_i = 0: the differences
/// that discretise the operator on Z / 2^k, d_k[x] s_k[x] = 2 d_{k-1}[x^2], k >= 0.
Mask<double> exponential_difference_mask(const Roots& roots, int level);

/// Green's function c at x, ∏ (d/dx - a_i) c = δ, 0 for x < 0: the divided difference of exp(a x) over all roots,
/// computed as the corner of the exponential of a bidiagonal matrix [Opitz 1964], with no loss where roots coincide or
/// nearly do. n(x) = Σ_i d_0[i] c(x - i).
double exponential_green_function(const Roots& roots, double x);

/// n(x), the limit from the right where it jumps. Not by that sum, which cancels when roots are small: n is carried
/// from each integer to the next by the matrix exponential of the equations n_j' = a_j n_j + w_j (n_{j-1}(x) - e^(a_j)
/// n_{j-1}(x - 1)) that build order j from order j - 1, w = a / (e^a - 1).
double exponential_spline_value(const Roots& roots, double x);

}  // namespace batten
