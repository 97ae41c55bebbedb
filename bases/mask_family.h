// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask.h>
#include <batten/bases/rational_elimination.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace batten {

/// Which maps of the plane leave a mask as it is.
enum class MaskSymmetry {
  Square,     ///< x -> -x, y -> -y, x <-> y
  Rectangle,  ///< x -> -x, y -> -y
  Point,      ///< (x, y) -> (-x, -y)
  None
};

/// The indices (i, j) of a mask of size N, n = (N - 1) / 2.
enum class MaskShape {
  Square,  ///< |i|, |j| <= n
  Disc,    ///< i² + j² <= n²
  Diamond  ///< |i| + |j| <= n
};

/// All derivatives of order < `order` of s vanish at this point, whose coordinates are 1 or -1.
struct PrescribedZero {
  Index<2> at;
  int order;
};

/// Which masks are wanted.
struct MaskConstraints {
  /// Degree d of polynomials that the scheme keeps: s(1,1) = 4 and zeros of order d + 1 at (-1,1), (1,-1), (-1,-1)
  /// [Warren & Weimer 2001, eq. 3.15].
  std::optional<int> precision;
  std::vector<PrescribedZero> zeros;
  MaskSymmetry symmetry = MaskSymmetry::Square;
  MaskShape shape = MaskShape::Square;
};

/// A linear condition on the unknowns of a family, with the words that name it.
struct NamedEquation {
  std::string name;
  ExactEquation equation;
};

/// The masks of a size, shape and symmetry: one unknown for each orbit of indices.
class MaskFamily {
public:
  /// Throws InvalidInput when the size is even or below `smallest`.
  MaskFamily(int size, MaskSymmetry symmetry, MaskShape shape = MaskShape::Square, int smallest = 1);

  int unknowns() const { return static_cast<int>(orbits_.size()); }
  /// The indices that share an unknown; the first one stands for them.
  const std::vector<Index<2>>& orbit(int unknown) const { return orbits_[static_cast<std::size_t>(unknown)]; }
  /// The unknown at an index, nothing where the mask is zero.
  std::optional<int> unknown_at(const Index<2>& i) const;
  /// The mask with these values of the unknowns.
  Mask2<Rational> mask(std::span<const Rational> values) const;

private:
  std::size_t place(const Index<2>& i) const;

  int half_;
  std::vector<std::vector<Index<2>>> orbits_;
  std::vector<int> unknown_of_place_;  // -1 outside the shape
};

/// The conditions of precision and prescribed zeros, those that follow from earlier ones left out. Throws InvalidInput
/// that names the first one that contradicts those before it, a precision below 0, and a zero that is not at (±1, ±1).
std::vector<NamedEquation> independent_equations(const MaskFamily& family, const MaskConstraints& constraints);

}  // namespace batten
