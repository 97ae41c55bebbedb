// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/scheme.h>

namespace batten {

// Schemes that keep the old points, s[0] = 1, s[arity i] = 0, centred at 0. Any weight w gives a scheme; that it
// converges, and how smooth its limits are, is for the theory of smoothness to tell.

/// New points (1/2 + w)(p_i + p_{i+1}) - w (p_{i-1} + p_{i+2}) [Dyn, Gregory & Levin 1987]. Continuous for |w| < 1/4,
/// C^1 for 0 < w < 1/8; reproduces cubics for w = 1/16 [Warren & Weimer 2001, sec. 3.2.4].
Scheme four_point_scheme(const Rational& w = Rational(1, 16));

/// New points on the polynomial of degree points - 1 through as many old ones [Deslauriers & Dubuc 1989]. Throws
/// InvalidInput unless the number of points is even, 2 to 64.
Scheme deslauriers_dubuc_scheme(int points);

/// New points (9/16 + 2w)(p_i + p_{i+1}) - (1/16 + 3w)(p_{i-1} + p_{i+2}) + w (p_{i-2} + p_{i+3}) [Weissman 1990].
/// Reproduces cubics, and for w = 3/256 quintics.
Scheme six_point_scheme(const Rational& w = Rational(3, 256));

/// Arity 3: new points a p_{i-1} + b p_i + c p_{i+1} + d p_{i+2} with a = -1/18 - w/6, b = 13/18 + w/2, c = 7/18 - w/2,
/// d = -1/18 + w/6 near p_i, mirrored near p_{i+1} [Hassan, Ivrissimtzis, Dodgson & Sabin 2002]. C^2 for 1/15 < w <
/// 1/9.
Scheme ternary_four_point_scheme(const Rational& w = Rational(1, 10));

/// New points on the edges of the triangulation with directions (1, 0), (0, 1), (1, 1): 1/2 at the ends of the edge, 2w
/// at the two opposite corners, -w at the four beyond [Dyn, Levin & Gregory 1990]. Reproduces cubics for w = 1/16.
Scheme2 butterfly_scheme(const Rational& w = Rational(1, 16));

/// Squares: new points on edges by the four-point rule along the edge, in faces 10/32 of the four corners less 1/32 of
/// the eight beyond; not a tensor product [Warren & Weimer 2001, sec. 3.3.4]. Reproduces cubics.
Scheme2 quad_interpolatory_scheme();

}  // namespace batten
