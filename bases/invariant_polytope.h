// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/exact_linear.h>
#include <batten/bases/smoothness_certificate.h>

#include <optional>

namespace batten {

/// A polytope that matrices keep within a multiple of itself.
struct PolytopeSearch {
  Rational radius;            ///< A P shall lie in radius · P
  Rational unit = {1, 1000};  ///< of the unit vectors among the vertices, the leading eigenvectors being of size 1
  int most_vertices = 500;    ///< beyond which the search ends
};

/// A polytope P with A_e P inside radius · P for all e; window and order are left for the caller to fill in. Nothing
/// when it would need more than most_vertices.
///
/// P starts as the hull of ± small unit vectors and of ± the leading eigenvectors of the matrices and of the best
/// product; images that lie outside are added until none does [Guglielmi & Protasov 2013]. It ends when the
/// radius exceeds the joint spectral radius. Found in doubles, the vertices rounded to multiples of 2^-48, so that what
/// is missing is small and exactly known.
template <int D>
std::optional<InvariantPolytope<D>> invariant_polytope(const std::vector<RationalMatrix>& matrices,
                                                       const PolytopeSearch& search);

}  // namespace batten
