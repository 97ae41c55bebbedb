// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/natural_cubic.h>

#include <vector>

namespace batten {

/// A curve as the sum of the least-energy curve through its values at every 2^k-th knot and of details, each of which
/// vanishes at the knots of the level below. The parts are orthogonal in the energy: energies add
/// [Warren & Weimer 2001, sec. 6.3.3].
struct CurveMultiresolution {
  NaturalCubic coarsest;              ///< q_0
  std::vector<NaturalCubic> details;  ///< r_0, r_1, ...: r_k has the knots of level k + 1

  /// q_k = q_0 + r_0 + ... + r_(k-1), with the knots of level k.
  NaturalCubic level(int k) const;
};

/// q_(k-1) = N_(k-1)^-1 U^T N_k q_k and r_(k-1) = q_k - S q_(k-1), for so many levels. Throws InvalidInput when the
/// number of cells is not a multiple of 2^levels, or too few are left.
CurveMultiresolution analysed(const NaturalCubic& fine, int levels);

/// Without the details of new knots where the curve changes by at most `threshold`, and what that costs.
struct CompressedCurve {
  CurveMultiresolution parts;
  int kept = 0;             ///< points: those of the coarsest level and the details that are left
  double energy_error = 0;  ///< energy of the difference, exact: the sum over the levels
};
CompressedCurve compressed(const CurveMultiresolution& parts, double threshold);

}  // namespace batten
