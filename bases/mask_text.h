// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask.h>

#include <ostream>
#include <string>
#include <string_view>

namespace batten {

/// As a person writes it, lowest power first: `1/8 x^-2 + 1/2 x^-1 + 3/4 + 1/2 x + 1/8 x^2`. In two variables `x^-1
/// y^2`, lowest power of y first; half powers as `x^(-1/2)`; zero is `0`. Doubles in the fewest digits that give them
/// back.
template <Coefficient T, int D>
std::string to_string(const LaurentPolynomial<T, D>& s);

/// An index as a person writes it: `3`, or `(3, -1)`.
template <int D>
std::string index_text(const Index<D>& i);

/// Writes to_string(s): failed tests show masks as a person reads them.
template <Coefficient T, int D>
std::ostream& operator<<(std::ostream& out, const LaurentPolynomial<T, D>& s) {
  return out << to_string(s);
}

/// An exact number: `3`, `-1/16`, `0.125`, `1e-3`. Throws InvalidInput otherwise.
Rational parse_rational(std::string_view text);

/// The mask whose coefficients are the comma-separated numbers, the first one that of x^offset. Throws InvalidInput
/// that names the place and the text of a coefficient that is not a number.
Mask<Rational> parse_mask(std::string_view text, int offset = 0);
/// The mask with one row of coefficients for each power of y, the lowest first, rows separated by `;`. All rows have
/// the same number of coefficients; spaces and line ends do not count. Throws InvalidInput as above, and on ragged
/// rows.
Mask2<Rational> parse_mask2(std::string_view text, const Index<2>& offset = {});

}  // namespace batten
