// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/mask_family.h>

#include <optional>
#include <span>
#include <vector>

namespace batten {

// How good the finite polyharmonic masks are, as in [Warren & Weimer 2001, sec. 5.2.4, fig. 5.16 and 5.17]. Jacobi
// masks have a = 1/8^m and exist for some sizes only.

/// A number for each of the four kinds of masks.
struct MaskMethods {
  double laurent;
  std::optional<double> jacobi;
  double least_squares;
  double optimal;
};

struct SizeComparison {
  int size;
  MaskMethods residual;  ///< residual_norm
};
/// One for each of the sizes. The constraints are those of the optimal and the least-squares masks.
std::vector<SizeComparison> compare_sizes(int order, std::span<const int> sizes,
                                          const MaskConstraints& constraints = {});

struct RoundsComparison {
  int rounds;
  MaskMethods residual;  ///< multilevel_residual
};
/// For 1 .. rounds rounds.
std::vector<RoundsComparison> compare_rounds(int order, int size, int rounds, const MaskConstraints& constraints = {});

struct LimitErrorOptions {
  int levels = 14;         ///< rounds of subdivision that stand for the limit
  int sample_level = 3;    ///< points where it is compared: Z²/2^sample_level
  double clearance = 0.5;  ///< for order 1: points nearer to the five spikes of the bell do not count
};
/// The largest |p(x) - n(x)| over the points x up to one unit beyond the support of p, which subdivision makes of a
/// single 1 at 0; n is the exact bell basis. Masks whose cosets do not sum to 1 have no limit: their errors grow with
/// the levels. Throws InvalidInput unless 0 <= sample_level <= levels, sample_level <= 6.
double limit_error(const Mask2<double>& s, int order, const LimitErrorOptions& options = {});
/// For masks of all four kinds.
MaskMethods compare_limits(int order, int size, const MaskConstraints& constraints = {},
                           const LimitErrorOptions& options = {});

}  // namespace batten
