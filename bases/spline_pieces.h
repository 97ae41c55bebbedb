// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/rational.h>

#include <span>
#include <vector>

namespace batten {

/// The B-splines of degree d that do not vanish in one cell, as polynomials in the local coordinate u = (t - b_c) /
/// (b_{c+1} - b_c): function c + a is Σ_p coefficients[a][p] u^p for a, p = 0 .. d. Exact.
struct SplinePiece {
  Rational length;  ///< b_{c+1} - b_c
  std::vector<std::vector<Rational>> coefficients;
  bool repeats = false;  ///< the piece of the cell before
};

/// The knots at and beyond the ends of the interval.
enum class EndKnots {
  Repeated,  ///< degree + 1 times: the clamped basis
  Continued  ///< as far apart as those of the first and last cell: uniform B-splines, cut off at the ends
};

/// The pieces of all cells of the B-spline basis on integer breakpoints, by the Cox-de Boor recursion in rationals [de
/// Boor 1978, ch. IX (14)].
std::vector<SplinePiece> spline_pieces(std::span<const int> breakpoints, int degree,
                                       EndKnots ends = EndKnots::Repeated);

/// ∫ N_i^(r) N_j^(s) dt over the whole interval, exact, for all i, j of the basis: entry [i][j - i + degree], zero
/// where j does not exist. Unit of length: that of the breakpoints.
std::vector<std::vector<Rational>> exact_inner_products(std::span<const int> breakpoints, int degree, int r, int s,
                                                        EndKnots ends = EndKnots::Repeated);

/// Weights of the finer basis in each function of the coarser one, N_j = Σ_i R_ij N̂_i, by the Oslo algorithm in
/// rationals [Cohen, Lyche & Riesenfeld 1980]: column j is returned as [j] = {first fine index, weights...}.
struct RefinementColumn {
  int first = 0;
  std::vector<Rational> weights;
};
std::vector<RefinementColumn> exact_refinement(std::span<const int> coarse, std::span<const int> fine, int degree);

}  // namespace batten
