// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/scheme.h>

#include <optional>
#include <vector>

namespace batten {

/// A function of bounded support whose restrictions to the intervals [first + c, first + c + 1] are polynomials: at
/// first + c + u it is Σ_p coefficients[c][p] u^p. All intervals have degree() + 1 coefficients.
struct ScalingPieces {
  Rational first;
  std::vector<std::vector<Rational>> coefficients;

  int degree() const { return static_cast<int>(coefficients.front().size()) - 1; }
};

/// The pieces of the scaling function of a stationary scheme with rational coefficients, exact; nothing when it has
/// none on intervals between shifts of the end of its support. Found by interpolation of arity-adic values, proved by
/// the refinement equation, which has one solution. Throws InvalidInput when the mask is not affine invariant.
std::optional<ScalingPieces> pieces_if_polynomial(const Scheme& scheme);

/// The derivative of an order on each interval; jumps between intervals do not count.
ScalingPieces derivative(const ScalingPieces& pieces, int order = 1);

/// The value at x, at ends of intervals the limit from the right.
Rational value(const ScalingPieces& pieces, const Rational& x);

}  // namespace batten
