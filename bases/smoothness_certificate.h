// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/local_spectrum.h>
#include <batten/bases/mask_matrix.h>

#include <vector>

namespace batten {

// Exact data that prove a statement about the limits of a stationary scheme to anyone who has its mask:
// certificate_check.h does the checking, smoothness.h and hoelder.h find them. "C^m" means that the data converge
// uniformly, and to C^m functions, from every bounded start.

/// Differences of this order, scaled to derivatives of order - 1, shrink: ‖T^power‖ = norm < 1.
///
/// One for each of the orders 1 .. m + 1 proves C^m [Dyn, Gregory & Levin 1991; Warren & Weimer 2001, th. 3.5,
/// 3.9 and 3.11].
template <int D>
struct Contraction {
  int order = 1;
  int steps = 1;  ///< rounds of subdivision in one of T
  int power = 1;
  Rational norm;
  MaskMatrix<Rational, D> scheme{1, 1};  ///< T; in one dimension a single mask
};

/// Near the fixed point limits are found that scale by an eigenvalue |λ| >= radius and are no polynomials: not C^m when
/// radius = arity^(-m n), not C^α for α > -log(radius) / (n log arity). See has_rough_eigenvalue; for m = 0 the data
/// themselves do not settle, as they would if the scheme converged.
template <int D>
struct Roughness {
  FixedPoint<D> point;
  Rational radius;
};

/// A coset of the mask sums to something other than 1: no convergence, as the limit f of p_k satisfies
/// f(x) = lim Σ_j s[arity j + coset] p_k[i - j] = sum · f(x) where f is not zero [Cavaretta, Dahmen & Micchelli 1991].
template <int D>
struct CosetDefect {
  Index<D> coset{};
  Rational sum;
};

/// The mask is x^shift 2^D ∏_d (1 + x^d)/2 over directions d, arity 2, and the data converge: the scaling function is
/// the box spline of the directions. With k the largest number of directions on a line through 0, of m, it is
/// C^(m-k-2), in one dimension (all on one) C^(m-2), no more, and has the Hölder exponent m-k-1 or m-1 [Warren & Weimer
/// 2001, sec. 2.2.2; de Boor, Höllig & Riemenschneider 1993]. Needed where different data have the same
/// limit, so that differences of the data tell less than those of limits.
template <int D>
struct BoxFactors {
  std::vector<Index<D>> directions;
  Contraction<D> convergence;  ///< of order 1
};

/// An upper bound of the joint spectral radius of the transition matrices A_e modulo polynomials of degree < order:
/// they map a polytope P, the hull of ± its vertices, into radius · P. Then every product of n of them has norm at most
/// radius^n in the norm with unit ball P [Guglielmi & Protasov 2013]. Limits are C^α for all
/// α < min(order, -log(radius) / log arity); see transition_matrices.
template <int D>
struct InvariantPolytope {
  /// coefficients[k] times vertex indices[k], added up.
  struct Combination {
    std::vector<int> indices;
    std::vector<Rational> coefficients;
  };

  int order = 1;
  std::vector<Index<D>> window;
  Rational radius;
  Rational unit;                                ///< the first vertices are unit times the unit vectors
  std::vector<std::vector<Rational>> vertices;  ///< the others
  /// images[e + digits v] is close to A_e vertex_v / radius; what is missing is made up of unit vectors.
  std::vector<Combination> images;
};

}  // namespace batten
