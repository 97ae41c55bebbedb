// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/scheme.h>
#include <batten/bases/smoothness_certificate.h>

#include <optional>
#include <string>

namespace batten {

struct SmoothnessOptions {
  int largest_power = 12;       ///< of ‖T^n‖ in one dimension
  int largest_power_2d = 6;     ///< of ‖T^n‖ in two dimensions
  int largest_continuity = 20;  ///< m beyond which nothing is asked
  /// Without it only proofs are looked for: obstacles of a mask of N x N take exact characteristic polynomials of about
  /// N² rows, a minute for N = 9.
  bool seek_obstacles = true;
};

/// How smooth the limits of a scheme are, and why.
template <int D>
struct Smoothness {
  int continuity = -1;  ///< the largest m for which C^m is proved; -1 for none
  /// Why C^continuity: one for each of the orders 1 .. continuity + 1.
  std::vector<Contraction<D>> proof;
  /// Why not C^(continuity + 1); nothing when that is undecided, or when a coset is to blame.
  std::optional<Roughness<D>> obstacle;
  std::optional<CosetDefect<D>> coset_defect;
  /// Why C^continuity and no more, where differences and fixed points leave it open.
  std::optional<BoxFactors<D>> box;
  int tried = 0;  ///< powers of the difference scheme that were tried for order continuity + 2

  bool is_decided() const { return obstacle || coset_defect || box; }
};

/// The verdict for a stationary scheme with a rational mask; throws InvalidInput for others.
///
/// Orders m = 0, 1, ... in turn: an obstacle is looked for at grid points and at the fixed points of the leading
/// products of transition matrices; where there is none, a contraction of differences of order m + 1.
template <int D>
Smoothness<D> smoothness(const SubdivisionScheme<D>& scheme, const SmoothnessOptions& options = {});

/// `C^1 because ‖T_2^2‖ = 3/4 < 1; not C^2 because ...`, or `... undecided up to n = 12`.
template <int D>
std::string explanation(const Smoothness<D>& verdict, int arity);

/// The box spline that a scheme's structure() says it has, when the mask is its and converges.
template <int D>
std::optional<BoxFactors<D>> box_factors(const SubdivisionScheme<D>& scheme);
/// Whether the mask is that of the box spline of these directions, wherever it is put.
template <int D>
bool has_box_factors(const LaurentPolynomial<Rational, D>& s, const std::vector<Index<D>>& directions);

/// The point x* whose digits a product of transition matrices follows.
template <int D>
FixedPoint<D> fixed_point(const std::vector<int>& factors, int arity);
/// Fixed points of one round: the grid point 0, and those halfway for arity 3.
template <int D>
std::vector<FixedPoint<D>> grid_fixed_points(int arity);

}  // namespace batten
