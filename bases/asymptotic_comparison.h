// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/smoothness.h>

#include <complex>
#include <functional>
#include <string>
#include <vector>

namespace batten {

/// ‖S_k - S_∞‖ <= beta alpha^k for all levels k >= from_level.
struct DecayBound {
  double beta = 0;
  Rational alpha;
  int from_level = 1;
  /// Why it holds, for all k. Empty: it was only seen on the levels looked at.
  std::string reason;
};

/// What is to be compared: the mask of level k is b_k[x] times `smoothing_factors` factors (1 + η_k x)/(1 + η_k),
/// η_k = e^(a/2^k), each with its own a, zero or not, possibly in complex pairs.
struct AsymptoticProblem {
  std::function<Mask<double>(int level)> rest;  ///< b_k, level 1, 2, ..., of sum 2
  Mask<Rational> limit;                         ///< b_∞
  int smoothing_factors = 0;
  DecayBound bound;  ///< of ‖B_k - B_∞‖
};

/// What is known of the smoothness of a non-stationary binary scheme.
struct AsymptoticSmoothness {
  int continuity = -1;          ///< C^continuity, if the bound holds on all levels; -1 for nothing
  bool proved_bound = false;    ///< whether the bound has a proof for all levels; otherwise the verdict is conditional
  int levels = 0;               ///< those on which the bound was looked at
  double largest_ratio = 0;     ///< the largest ‖B_k - B_∞‖ / (beta alpha^k) on them
  int first_violation = 0;      ///< the first level on which the bound fails beyond rounding; 0 for none
  Smoothness<1> limit_verdict;  ///< of b_∞, with its certificate
  std::string explanation;
};

/// The rest b_k is C^m when Σ_k 2^(mk) ‖B_k - B_∞‖ < ∞, so when alpha < 2^-m, and b_∞ is C^m
/// [Dyn & Levin 1995; Warren & Weimer 2001, sec. 4.4.4]; each smoothing factor adds one
/// [Dyn & Levin 1995; Dyn & Levin 2002]. What the comparison proves, not what is best possible: no
/// upper bound of the smoothness is given. The masks of levels 1 .. levels are looked at: a level that violates the
/// bound takes the verdict back to -1.
AsymptoticSmoothness asymptotic_smoothness(const AsymptoticProblem& problem, int levels = 20);

/// The unified tension scheme (1, 2+2σ_k, 2+4σ_k, 2+2σ_k, 1)/(4+4σ_k), σ_k = √((1+σ_(k-1))/2), σ_0 > -1: C².
///
/// s_k = ((1+x)/2)² b_k, b_k = (1 + 2σ_k x + x²)/(1+σ_k), and ‖B_k - B_∞‖ = |1-σ_k|/(1+σ_k) <= |1-σ_0| 2^-k, because
/// 0 < (1-σ_k)/(1-σ_(k-1)) = 1/(2(1+σ_k)) < 1/2 [Warren & Weimer 2001, sec. 4.4.4]. The comparison of s_k itself, with
/// this ratio, would give no more than C^0: alpha < 2^-2 is not reached for σ_0 < 1.
AsymptoticProblem tension_problem(double sigma);

/// Exponential B-splines of ∏ (d/dx - a_i), real a_i or complex pairs, order m >= 2: C^(m-2).
///
/// b_k = 2 (1+η_1 x)(1+η_2 x)/((1+η_1)(1+η_2)) of two roots that are real or a pair, the others as smoothing factors.
/// With e_i = (1-η_i)/(1+η_i) = -tanh(a_i/2^(k+1)), b_k - b_∞ has coset sums at most |e_1 + e_2| + |e_1 e_2|, and
/// |e_i| <= |a_i| 2^-k from the level on which |a_i| <= 2^(k+1): |tanh z| <= tan|z| <= 2|z| for |z| <= 1. Throws
/// InvalidInput unless there are two roots or more and complex ones come in pairs.
AsymptoticProblem exponential_spline_problem(std::vector<std::complex<double>> roots);

}  // namespace batten
