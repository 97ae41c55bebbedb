// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/curve_lanes.h>

namespace batten {

// The sweeps of smoothing_blocks.h along the blocks of a group. Kernels take one or two components at once: the
// covariances of the filter, which are the same for all, are found anew for each pair.

constexpr int most_together = 2;

/// Consecutive steps and where the numbers of each lane are. Those of weight 1 in all lanes are not looked up.
struct StepLines {
  int components, count, equal;     // so many steps; the first so many of weight 1. Multiples of lane_chunk
  double per_unit, per_weight;      // lengths and weights are multiplied by these, after which λ is 1
  const double* knots[lane_count];  // of the steps and of the one behind them
  const double* weights[lane_count];
  const double* points[most_together][lane_count];
};
/// Whole blocks, and where the coefficients of their first `shared` steps, which all lanes have, belong.
struct CoefficientLines {
  int components, count, equal, shared;  // multiples of lane_chunk
  double* coefficients[most_together][lane_count];
};

/// What is read of steps that follow each other, and what one sweep leaves for the next. Steps are advanced in chunks.
/// Empty steps have width and weight 0; what comes out at them and at the ends of an open curve is not used.
struct SmoothingSteps {
  /// Steps of whole blocks where the sweep back follows, of a tile otherwise.
  SmoothingSteps(int count, bool has_sweep_back);

  LaneSteps widths;                                  // from that of the cell before the first step
  LaneSteps weights;                                 // w
  LaneSteps points[most_together];                   // b; replaced by updated means, then by coefficients
  LaneSteps gain, slope_gain, pulls[most_together];  // P_00 / S, P_10 / S, w (b - m_0) / S with S = 1 + w P_00
};

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

/// The element after steps, of which a tile is kept, from that before them.
void describe(const StepLines& lines, SmoothingSteps& steps, LaneElement& element);

/// Mean and covariance of the filter.
struct LaneFilter {
  LaneCovariance p;
  LaneState means[most_together];
};

/// The filter after steps, which are kept from this place on, from that before them.
void sweep_forwards(const StepLines& lines, int from, SmoothingSteps& steps, LaneFilter& filter);

/// Coefficients in place of the points and in their lines, from the costates behind all steps, where the spline has
/// these values.
void sweep_back(const LaneState* costates, const Lanes* values, SmoothingSteps& steps, const CoefficientLines& lines);

}  // namespace batten
