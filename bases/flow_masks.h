// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/index_box.h>
#include <batten/bases/lattice_green.h>
#include <batten/bases/mask.h>

namespace batten {

// Subdivision of plane flows on staggered grids [Warren & Weimer 2001, sec. 5.3]. u lives on vertical walls, with
// exponents in Z x (Z + 1/2), v on horizontal ones, (Z + 1/2) x Z, and
//   u_k = s11 u_{k-1}[x²,y²] + s12 v_{k-1}[x²,y²],   v_k = s21 u_{k-1}[x²,y²] + s22 v_{k-1}[x²,y²].
// With d[x] = x^(-1/2) - x^(1/2), which takes the value on the left from that on the right, and l = d[x]² + d[y]², the
// exact masks, which are no polynomials, obey
//   d[x] s11 + d[y] s21 = 0,
//   perfect flow:   d[y] s11 - d[x] s21  = 2 d[y²],
//   slow flow:   l (d[y] s11 - d[x] s21) = (1/2) l[x²,y²] d[y²].

enum class Flow {
  Perfect,  ///< u_x + v_y = 0, u_y - v_x = 0 but at grid points
  Slow      ///< u_x + v_y = 0, Δ(u_y - v_x) = 0 but at grid points: creeping (Stokes) flow
};

/// What finite masks do to the divergence of a field.
enum class FlowKind {
  Book,      ///< d[x] s11 + d[y] s21 = 0 as nearly as can be: divergence is taken away [ibid., sec. 5.3.4]
  Commuting  ///< d[x] s11 + d[y] s21 = m d[x²], m = flux_mask(): each cell's divergence passes to its four children, so
             ///< that fields without divergence keep none, to rounding
};

/// The first column of the matrix of masks; the second is its mirror image in x = y. s11 has exponents in Z x (Z+1/2)
/// and is even in x and in y, s21 has exponents in (Z+1/2) x Z and is odd in both.
template <Coefficient T>
struct FlowMasks {
  Mask2<T> s11, s21;

  Mask2<T> s12() const { return swapped(s21); }
  Mask2<T> s22() const { return swapped(s11); }
};
FlowMasks<double> to_double(const FlowMasks<Rational>& masks);

/// d[x^n] for axis 0, d[y^n] for axis 1.
Mask2<Rational> staggered_difference(int axis, int n = 1);
/// m = (x^(1/2) + x^(-1/2)) (y^(1/2) + y^(-1/2)) / 2.
Mask2<Rational> flux_mask();

/// By how much masks miss the laws.
template <Coefficient T>
struct FlowResiduals {
  Mask2<T>
      divergence;  ///< d[x] s11 + d[y] s21, less m d[x²] for the commuting kind; at cell centres, odd in x, even in y
  Mask2<T> rotation;  ///< left less right side of the second law; at vertices, even in x, odd in y
};
template <Coefficient T>
FlowResiduals<T> flow_residuals(Flow flow, FlowKind kind, const FlowMasks<T>& masks);

/// The most that a residual adds to what it stands for at one place of the fine grid, over all coarse fields with
/// |u|, |v| <= 1; differences are not divided by the spacing. Of a residual of the first column and its mirror image:
/// the largest sum of |r| over the indices that meet there.
template <Coefficient T>
T flow_norm(const Mask2<T>& residual);

/// Coefficients of the exact masks for perfect flow, 2 d[y] d[y²] / l at x^i y^(j+1/2) and -2 d[x] d[y²] / l at
/// x^(i+1/2) y^j: differences of the lattice Green's function. Far out they fall like r^-2.
PiNumber perfect_s11(LatticeGreen& green, int i, int j);
PiNumber perfect_s21(LatticeGreen& green, int i, int j);

/// The coefficients of the exact masks within |exponent| <= size / 2, size odd and >= 3 (else InvalidInput), absolute
/// errors below 1e-12: perfect flow from the lattice Green's function, slow flow by quotient_coefficients(). Neither
/// law holds for what is cut out, nor are constants kept.
FlowMasks<double> truncated_flow_masks(Flow flow, int size);

/// Component u of level k >= 1 that the exact scheme makes of a single coarse u = 1 at (0, 0), on the walls
/// (i, j + 1/2) / 2^k, (i, j) of a box: 2^k d[y] d[y^n] / l, n = 2^k, for slow flow times l[x^n,y^n] / (4^k l). Errors
/// as above. Throws InvalidInput when k < 1.
Mask2<double> exact_flow_rounds(Flow flow, int k, const IndexBox<2>& box);

/// Throws InvalidInput that names the function unless size is odd and >= 3.
void require_flow_size(const char* function, int size);

}  // namespace batten
