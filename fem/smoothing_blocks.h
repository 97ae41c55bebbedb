// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/interpolation_blocks.h>

#include <Eigen/Core>

#include <span>
#include <vector>

namespace batten {

/// What a smoothing spline is of.
struct SmoothingProblem {
  std::span<const double> knots;
  const Eigen::MatrixXd& points;
  std::span<const double> weights;  ///< none: all are equal
  /// Lengths and weights are multiplied by these, after which λ = 1 and no weight is larger.
  double per_unit, per_weight;
  bool closed;

  int rows() const { return static_cast<int>(points.rows()); }
};

/// The coefficients of the natural cubic spline that minimises Σ_i w_i |p(t_i) - b_i|² + λ ∫ |p''|² dt.
///
/// The state x = (p, p') at a knot is that of a particle under random forces; the spline is its expectation, given
/// noisy positions [Wecker & Ansley 1983]. In units of weight and length where the largest weight and λ are 1,
/// x goes across a cell of width h to A x + noise of covariance q, A = (1 h; 0 1), q = (h³/3 h²/2; h²/2 h), and the
/// variance of the noise of a position of weight w is 1 / w. Within a block, from a known state at its begin, the
/// Kalman filter carries mean m and covariance P; every term of (P, det P) is a sum of positive ones, so that nothing
/// cancels however far λ smooths. Backwards the costate y = (-p''', p'') left of a knot gives x = m + P y [Bryson &
/// Frazier 1963]. What a block says about the states at its ends has five parts that can be combined [Särkkä &
/// García-Fernández 2021]: the states between blocks are found first, then all blocks are filled in independently.
FoundCoefficients smoothing_coefficients(const SmoothingProblem& problem);

/// A block seen from its ends: given the state x at its begin, that at its end is A x + b with covariance C; its points
/// say about x what the quadratic form J and the linear form κ say. One column of b and κ for each component.
struct BlockElement {
  Eigen::Matrix2d a = Eigen::Matrix2d::Identity(), c = Eigen::Matrix2d::Zero(), j = Eigen::Matrix2d::Zero();
};
using StateColumns = Eigen::Matrix<double, 2, Eigen::Dynamic>;

/// States at the begin of each block, costates at its end: columns d k .. d k + d - 1 for block k.
struct BlockEnds {
  StateColumns states, costates;
};

/// Those of the spline, from the elements of consecutive blocks and their b and κ, laid out alike.
BlockEnds joined_blocks(std::span<const BlockElement> elements, const StateColumns& b, const StateColumns& kappa,
                        bool closed);

}  // namespace batten
