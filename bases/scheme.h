// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask.h>

#include <complex>
#include <functional>
#include <optional>
#include <string>

namespace batten {

/// How new points lie to old ones in each direction when the grid is refined: Primal masks have an odd number of
/// coefficients, their middle is an old point; Dual masks have an even number, no new point lies where an old one was.
/// Mixed differs between x and y.
enum class Placement { Primal, Dual, Mixed };

/// The pieces that a scaling function is known to have. Empty where nothing is known.
template <int D>
struct SplineStructure {
  /// n is the box spline of these directions, moved to the scheme's support; in one dimension, m times 1 for the
  /// B-spline of order m.
  std::vector<Index<D>> directions;
  /// n is the exponential B-spline of ∏ (d/dx - root), in one dimension.
  std::vector<std::complex<double>> roots;
};

/// A subdivision scheme on Z^D: p_k[x] = s_k[x] p_{k-1}[x^arity], where coefficient i of p_k belongs to the position
/// i / arity^k and s_k is the mask of the step from level k - 1 to level k, k = 1, 2, ...
/// [Warren & Weimer 2001, eq. 2.10]. The book writes s_{k-1} for the same mask.
///
/// A stationary scheme has one mask s and a scaling function n(x) = Σ_i s[i] n(arity x - i) with integral 1 and the
/// limit Σ_i p_0[i] n(x - i).
template <int D>
class SubdivisionScheme {
public:
  using ExactMask = LaurentPolynomial<Rational, D>;
  using RealMask = LaurentPolynomial<double, D>;
  using Structure = SplineStructure<D>;
  /// The mask of each level, 1, 2, ...
  using MaskOfLevel = std::function<RealMask(int level)>;

  /// A stationary scheme, exact. Throws InvalidInput unless the arity is 2 or 3 and the mask sums to arity^D.
  SubdivisionScheme(std::string name, ExactMask mask, int arity = 2, Structure structure = {});
  /// A stationary scheme whose coefficients are not rational. Throws as above; the sum may err by 64 ε Σ |s[i]|.
  SubdivisionScheme(std::string name, RealMask mask, int arity = 2, Structure structure = {});
  /// A non-stationary scheme: masks on the box of the first one, or a smaller one. Throws as above when the first mask
  /// does.
  SubdivisionScheme(std::string name, MaskOfLevel mask, int arity = 2, Structure structure = {});

  const std::string& name() const { return name_; }
  int arity() const { return arity_; }
  bool is_stationary() const { return !mask_of_level_; }
  /// Whether exact_mask() exists.
  bool is_exact() const { return exact_.has_value(); }
  const Structure& structure() const { return structure_; }

  /// The mask of the step from level - 1 to level. Throws InvalidInput when level < 1.
  RealMask mask(int level = 1) const;
  /// Throws InvalidInput when the scheme is not stationary or its coefficients are not rational.
  const ExactMask& exact_mask() const;
  /// Σ of the mask of a level: arity^D.
  double mask_sum(int level = 1) const;

  /// Ends of the support of the scaling function, those of the mask over arity - 1. Half shifts count.
  struct Support {
    std::array<Rational, static_cast<std::size_t>(D)> lower, upper;
  };
  Support support() const;
  Placement placement() const;
  /// Whether old points are kept: s[0] = 1 and s[arity i] = 0 otherwise, on levels 1 to 8 of a non-stationary scheme;
  /// over doubles to 64 ε.
  bool is_interpolatory() const;

private:
  std::string name_;
  int arity_;
  std::optional<ExactMask> exact_;
  RealMask first_;  // the mask of level 1
  MaskOfLevel mask_of_level_;
  Structure structure_;
};

using Scheme = SubdivisionScheme<1>;
using Scheme2 = SubdivisionScheme<2>;

/// Throws InvalidInput that says which coset sums to what unless every coset of the mask sums to 1, so that constants,
/// and with them affine maps, are reproduced [Warren & Weimer 2001, sec. 3.2.1]. Levels 1 to 8 of a non-stationary
/// scheme; over doubles to 64 ε Σ |s[i]|.
template <int D>
void require_affine_invariance(const SubdivisionScheme<D>& scheme);

/// The scheme with a mask of the user's own, named "custom".
template <int D>
SubdivisionScheme<D> custom_scheme(const LaurentPolynomial<Rational, D>& mask, int arity = 2) {
  return {"custom", mask, arity};
}

/// The scheme moved so that the support of its scaling function is symmetric about 0, by half shifts where its length
/// is odd: polygons do not drift [Warren & Weimer 2001, sec. 2.1.3].
template <int D>
SubdivisionScheme<D> centred(const SubdivisionScheme<D>& scheme);

/// The scheme of s_a[x] s_b[y], whose scaling function is n_a(x) n_b(y). Throws InvalidInput when the arities differ.
Scheme2 tensor_product(const Scheme& a, const Scheme& b);

}  // namespace batten
