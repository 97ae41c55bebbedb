// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask_text.h>
#include <batten/bases/scheme.h>

#include <initializer_list>

// Schemes written down from their masks, without the library's catalogue.
namespace batten::test {

using Q = Rational;

/// s^m[x] = arity^(1-m) (1 + x + ... )^m, n on [0, m] [Warren & Weimer 2001, eq. 2.7].
inline Scheme b_spline_by_hand(int m, int arity = 2) {
  const Mask<Q> box(0, std::vector<Q>(static_cast<std::size_t>(arity), Q(1)));
  auto s = box;
  for (int k = 1; k < m; ++k) s *= Q(1, arity) * box;
  return {"b-spline", s, arity};
}

/// 4 ∏ (1 + x^a y^b) / 2 [Warren & Weimer 2001, eq. 2.16].
inline Scheme2 box_spline_by_hand(std::initializer_list<Index<2>> directions) {
  auto s = Mask2<Q>::constant(4);
  for (const auto& direction : directions) s *= Q(1, 2) * (Mask2<Q>::constant(1) + Mask2<Q>::monomial(direction));
  return {"box-spline", s};
}

inline Scheme2 zwart_powell_by_hand() { return box_spline_by_hand({{1, 0}, {0, 1}, {1, 1}, {-1, 1}}); }
inline Scheme2 quartic_by_hand() { return box_spline_by_hand({{1, 0}, {1, 0}, {0, 1}, {0, 1}, {1, 1}, {1, 1}}); }

inline Scheme four_point_by_hand() { return {"four-point", parse_mask("-1/16,0,9/16,1,9/16,0,-1/16", -3)}; }

/// [Warren & Weimer 2001, sec. 3.3.4], rows from y^-3 up.
inline Scheme2 butterfly_by_hand() {
  return {"butterfly", Q(1, 16) * parse_mask2("0,-1,-1,0,0,0,0; -1,0,2,0,-1,0,0; -1,2,8,8,2,-1,0; 0,0,8,16,8,0,0;"
                                              "0,-1,2,8,8,2,-1; 0,0,-1,0,2,0,-1; 0,0,0,0,-1,-1,0",
                                              {-3, -3})};
}

/// The interpolating quad scheme [Warren & Weimer 2001, sec. 3.3.4], rows from y^-3 up.
inline Scheme2 quad_by_hand() {
  return {"quad-interpolatory",
          Q(1, 32) * parse_mask2("0,0,-1,-2,-1,0,0; 0,0,0,0,0,0,0; -1,0,10,18,10,0,-1; -2,0,18,32,18,0,-2;"
                                 "-1,0,10,18,10,0,-1; 0,0,0,0,0,0,0; 0,0,-1,-2,-1,0,0",
                                 {-3, -3})};
}

}  // namespace batten::test
