// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/scheme.h>
#include <batten/bases/smoothness_certificate.h>

#include <optional>

namespace batten {

/// Bounds of the Hölder exponent: the supremum of all α for which every limit is C^α, that is C^m with m-th derivatives
/// that are Hölder continuous of order α - m, m the largest integer below α. A C^m function whose m-th derivative is
/// Lipschitz continuous has the exponent m + 1, B-splines of order m the exponent m - 1.
template <int D>
struct HoelderBounds {
  double lower = 0;
  double upper = 0;
  InvariantPolytope<D> lower_proof;
  Roughness<D> upper_proof;
  std::optional<BoxFactors<D>> box;  ///< instead of both proofs, where the exponent is that of a box spline
};

struct HoelderOptions {
  double gap = 0.045;       ///< how far apart the bounds may be, when the search for a polytope allows
  int most_vertices = 700;  ///< of a polytope
};

/// Rigorous bounds for a convergent stationary scheme with a rational mask: certificates are exact, the logarithms are
/// rounded outward by 1e-12. lower is at most the order of the sum rules.
///
/// Exact for schemes whose structure() is a box spline. Otherwise the upper bound is the scaling of the limits at a
/// fixed point, the lower one minus the logarithm of an upper bound of the joint spectral radius; see Roughness and
/// InvariantPolytope. Bounds farther apart than asked mean that the search gave up. Throws InvalidInput for a scheme
/// without rational mask or without sum rules, SolverError when no bounds are found, as for divergent schemes.
template <int D>
HoelderBounds<D> hoelder_bounds(const SubdivisionScheme<D>& scheme, const HoelderOptions& options = {});

/// min(order, -log(radius) / log arity), rounded down.
template <int D>
double exponent_of(const InvariantPolytope<D>& polytope, int arity);
/// -log(radius) / (n log arity), rounded up.
template <int D>
double exponent_of(const Roughness<D>& roughness, int arity);

}  // namespace batten
