// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/rational.h>

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace batten {

/// Σ factor · unknown = right, over terms (unknown, factor). An unknown may occur more than once.
struct ExactEquation {
  std::vector<std::pair<int, Rational>> terms;
  Rational right = 0;
};

/// The unknowns 0 .. unknowns - 1 that satisfy all equations; nothing when no choice does, or more than one.
///
/// What is returned is exact: it was found modulo powers of a prime [Dixon 1982] and put into every equation. "Nothing"
/// is exact too where equations contradict each other; where the equations leave a choice, it is concluded from the
/// same choice modulo three primes. Throws InvalidInput when a term names an unknown that does not exist.
///
/// Work: n^3 / 3 machine multiplications for n unknowns, fewer where equations are sparse, and n^2 for each 26 bits of
/// the answer's numerators and denominators.
std::optional<std::vector<Rational>> unique_solution(std::span<const ExactEquation> equations, int unknowns);

}  // namespace batten
