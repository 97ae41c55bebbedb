// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/scheme.h>

#include <span>
#include <vector>

namespace batten {

// Box splines n of a set Σ of m integer directions in the plane, repetitions allowed: the density at (x, y) of
// Σ_i t_i (a_i, b_i), t uniform in the unit cube [Warren & Weimer 2001, sec. 2.2]. Piecewise polynomial of degree m -
// 2, ∫ n = 1, Σ_ij n(x - i, y - j) = 1. All functions throw InvalidInput when a direction is (0, 0) or Σ does not span
// the plane, and for more than 24 directions.

using Directions = std::vector<Index<2>>;

/// s[x, y] = 4 ∏ (1 + x^a y^b) / 2 [Warren & Weimer 2001, eq. 2.16].
Mask2<Rational> box_mask(const Directions& directions);

/// The scheme of that mask. Its subdivision converges to Σ p n where Σ spans Z^2 modulo 2, as when it holds (1, 0) and
/// (0, 1); require_affine_invariance() tells.
Scheme2 box_scheme(const Directions& directions);

/// p_k from p_{k-1} = p by p -> 4 p[x^2, y^2] and averaging along each direction, p -> (1 + x^a y^b) p / 2
/// [Warren & Weimer 2001, sec. 2.2.3].
Mask2<Rational> box_averaged(const Mask2<Rational>& p, const Directions& directions);

/// d[x, y] = ∏ (1 - x^a y^b): n = Σ d[i, j] c(x - i, y - j), c the cone spline [Warren & Weimer 2001, th. 2.5].
Mask2<Rational> box_difference_mask(const Directions& directions);

/// α - 2 where n is C^(α-2), -1 when it has jumps: α is the size of the smallest part of Σ without which the rest does
/// not span, m less the largest number of parallel directions [Warren & Weimer 2001, sec. 2.2.2].
int box_continuity(const Directions& directions);
/// The same on the line, where box splines of m directions are B-splines of order m: m - 2.
inline int box_continuity(const std::vector<Index<1>>& directions) { return static_cast<int>(directions.size()) - 2; }

/// The corners of the support, the zonogon { Σ t_i (a_i, b_i), 0 <= t_i <= 1 }, counter-clockwise from the lowest (of
/// these the leftmost).
std::vector<Index<2>> zonogon(const Directions& directions);

/// Whether the integer translates of n are linearly independent: all bases in Σ have determinant ±1
/// [de Boor, Höllig & Riemenschneider 1993, ch. II].
bool has_independent_translates(const Directions& directions);

/// ∂^order of n at a point, exact, by cone splines. On the lines where n has several pieces the value is the limit from
/// (x + ε, y + ε^2), so that boxes contain their left and lower sides; derivatives are those of the pieces and exist
/// wherever asked for, up to any order. The order is not negative.
Rational box_spline_value(const Directions& directions, const Rational& x, const Rational& y,
                          const Index<2>& order = {});
/// The same for doubles, derived exactly and rounded once.
double box_spline_value(const Directions& directions, double x, double y, const Index<2>& order = {});

/// ∂^order of the cone spline c, the density of Σ_i t_i (a_i, b_i), t_i >= 0 [Warren & Weimer 2001, sec. 2.3.2]:
/// homogeneous of degree m - 2, c(2x, 2y) = 2^(m-2) c(x, y). Limits as above. Throws InvalidInput as well when the
/// directions do not lie in the half plane y > 0 or (y = 0, x > 0), where c is finite.
Rational cone_spline_value(const Directions& directions, const Rational& x, const Rational& y,
                           const Index<2>& order = {});

}  // namespace batten
