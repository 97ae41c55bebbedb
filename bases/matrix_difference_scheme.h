// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask_matrix.h>

namespace batten {

/// How the difference scheme is looked for.
struct MatrixDifferenceOptions {
  int order = 1;   ///< of the differences
  int steps = 1;   ///< rounds of s that one round of T stands for
  int margin = 0;  ///< by how much entries may reach beyond the box that the mask gives them
};

/// The matrix scheme T of the differences of s of an order q, for which is_difference_scheme holds, with the least norm
/// ‖T‖ among those of the given support: q + 1 rows and columns in two dimensions [Warren & Weimer 2001, th. 3.10]. T
/// is not unique, neither is the one with least norm; its norm is.
///
/// A linear program for each row and coset, which do not depend on each other: minimise Σ_j ‖A_j‖₁ subject to
/// Σ_j A_j[x] (1-x)^(q-j) (1-y)^j = C[x], C the coset of arity^((q-1) steps) (1-x)^(q-i) (1-y)^i s_n [ibid.,
/// sec. 3.3.2]. The identity holds exactly; the norm is the least one up to rounding in the search.
///
/// In one dimension it is difference_scheme's mask, taken `steps` times. Throws InvalidInput when there is none: s has
/// not the sum rules of this order, or the support is too small.
template <int D>
MaskMatrix<Rational, D> matrix_difference_scheme(const LaurentPolynomial<Rational, D>& s,
                                                 const MatrixDifferenceOptions& options, int arity = 2);

/// The row (A_j) with least Σ_j ‖A_j‖₁ and Σ_j A_j[x] δ_j[x] = c[x], δ the operators of differences of an order, on the
/// box of c. As above; throws InvalidInput when there is none.
std::vector<Mask2<Rational>> least_difference_row(const Mask2<Rational>& c, int order, int margin = 0);

/// The first differences' T = diag(s / (1 + x), s / (1 + y)), 1 + ... + x^(arity-1) for other arities: a certificate of
/// order 1 without search, where both factors divide s, as they do for box splines with the directions (1,0) and (0,1)
/// [Warren & Weimer 2001, sec. 3.3.1]. Throws InvalidInput when a factor is missing.
MaskMatrix<Rational, 2> factored_difference_scheme(const Mask2<Rational>& s, int arity = 2);

}  // namespace batten
