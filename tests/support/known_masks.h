// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask_text.h>
#include <batten/bases/scheme.h>

#include <string_view>

// Masks by hand, from the sources, so that tests of smoothness do not rest on the catalogue of schemes.
namespace batten::test {

/// 2 ((1 + x)/2)^m [Warren & Weimer 2001, eq. 2.7].
inline Mask<Rational> bspline_mask(int m) {
  return power(Mask<Rational>(0, {Rational(1, 2), Rational(1, 2)}), m) * Rational(2);
}
/// {-w, 0, 1/2+w, 1, 1/2+w, 0, -w} [Dyn, Gregory & Levin 1987].
inline Mask<Rational> four_point_mask(const Rational& w) {
  const Rational b = Rational(1, 2) + w;
  return {-3, {-w, 0, b, 1, b, 0, -w}};
}
/// Odd weights {θ, -(1/16+3θ), 9/16+2θ, ...} [Weissman 1990].
inline Mask<Rational> six_point_mask(const Rational& theta) {
  const Rational b = -(Rational(1, 16) + 3 * theta), c = Rational(9, 16) + 2 * theta;
  return {-5, {theta, 0, b, 0, c, 1, c, 0, b, 0, theta}};
}
/// Six points, degree 5 [Deslauriers & Dubuc 1989].
inline Mask<Rational> deslauriers_dubuc_mask() {
  return parse_mask("3,0,-25,0,150,256,150,0,-25,0,3", -5) * Rational(1, 256);
}
/// [Hassan, Ivrissimtzis, Dodgson & Sabin 2002]
inline Mask<Rational> ternary_four_point_mask(const Rational& w) {
  const Rational a = -Rational(1, 18) - w / 6, b = Rational(13, 18) + w / 2, c = Rational(7, 18) - w / 2,
                 d = -Rational(1, 18) + w / 6;
  return {-5, {d, a, 0, c, b, 1, b, c, 0, a, d}};
}

inline Mask2<Rational> scaled_mask(std::string_view text, const Index<2>& offset, int denominator) {
  return parse_mask2(text, offset) * Rational(1, denominator);
}
/// [Warren & Weimer 2001, sec. 2.2.4]
inline Mask2<Rational> zwart_powell_mask() { return scaled_mask("0,1,1,0;1,2,2,1;1,2,2,1;0,1,1,0", {-1, 0}, 4); }
inline Mask2<Rational> three_direction_linear_mask() { return scaled_mask("1,1,0;1,2,1;0,1,1", {0, 0}, 2); }
inline Mask2<Rational> three_direction_quartic_mask() {
  return scaled_mask("1,2,1,0,0;2,6,6,2,0;1,6,10,6,1;0,2,6,6,2;0,0,1,2,1", {0, 0}, 16);
}
/// w = 1/16 [Warren & Weimer 2001, sec. 3.3.4].
inline Mask2<Rational> butterfly_mask() {
  return scaled_mask(
      "0,-1,-1,0,0,0,0;-1,0,2,0,-1,0,0;-1,2,8,8,2,-1,0;0,0,8,16,8,0,0;0,-1,2,8,8,2,-1;0,0,-1,0,2,0,-1;0,0,0,0,-1,-1,0",
      {-3, -3}, 16);
}
/// [Warren & Weimer 2001, sec. 3.3.4]
inline Mask2<Rational> quad_interpolatory_mask() {
  return scaled_mask(
      "0,0,-1,-2,-1,0,0;0,0,0,0,0,0,0;-1,0,10,18,10,0,-1;-2,0,18,32,18,0,-2;-1,0,10,18,10,0,-1;0,0,0,0,0,0,0;"
      "0,0,-1,-2,-1,0,0",
      {-3, -3}, 32);
}

}  // namespace batten::test
