// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/curve_lanes.h>

namespace batten {

// The sweeps of smoothing_blocks.h along the blocks of a group. Kernels take one or two components at once: the
// covariances of the filter, which are the same for all, are found anew for each pair.

constexpr int most_together = 2;
constexpr double most_soft = 1e100;  // of a point that does not count

/// What is read of steps that follow each other, and what one sweep leaves for the next. Empty steps have width 0; what
/// comes out at them and at the ends of an open curve is not used.
struct SmoothingSteps {
  /// Steps of whole blocks where the sweep back follows, of a tile otherwise.
  SmoothingSteps(int count, bool has_sweep_back);

  LaneSteps widths;                                  // from that of the cell before the first step
  LaneSteps softness;                                // λ / w
  LaneSteps points[most_together];                   // b; replaced by coefficients
  LaneSteps gain, slope_gain, pulls[most_together];  // P_00 / S, P_10 / S, (b - m_0) / S with S = P_00 + λ / w
};

/// The same number everywhere.
void fill_lanes(LaneStep* steps, int count, double number);
/// λ / w in place of weights w, but not less than 1e-100 nor more than most_soft, which is what 0 gets.
void soften(LaneStep* weights, int count, double lambda);

struct LaneState {
  Lanes value, slope;
};
/// (u v; v z) and its determinant.
struct LaneCovariance {
  Lanes u, v, z, det;
};

/// What the steps so far say about the ends of their block, see BlockElement.
struct LaneElement {
  LaneElement();

  Lanes a[4];  // rows
  LaneCovariance c;
  Lanes j_uu, j_us, j_ss;
  LaneState b[most_together], kappa[most_together];
};

/// The element after the first `count` steps, from that before them.
void describe(const SmoothingSteps& steps, int count, int components, LaneElement& element);

/// Mean and covariance of the filter.
struct LaneFilter {
  LaneCovariance p;
  LaneState means[most_together];
};

/// The filter after steps begin .. end - 1, from that before them.
void sweep_forwards(SmoothingSteps& steps, int begin, int end, int components, LaneFilter& filter);

/// Coefficients in place of the points of the first `count` steps, from the costates behind them, where the spline has
/// these values.
void sweep_back(SmoothingSteps& steps, int count, int components, const LaneState* costates, const Lanes* values);

}  // namespace batten
