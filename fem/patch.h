// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/measurement.h>
#include <batten/fem/spline_level.h>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace batten {

/// One step of a hierarchy, with its measurements: what patches are cut from.
struct PatchedStep {
  const SplineLevel& coarse;
  const SplineLevel& fine;
  const MeasurementMatrix& measurements;
  const std::vector<int>& private_functions;  ///< of each measurement
  Measurement kind;
};

/// A block of coarse cells, first .. last in each direction.
struct Patch {
  int first_x, last_x, first_y, last_y;
  PlaceRange places_x, places_y;
};

/// Least energy on a patch, free at its border, for the measurements whose functions are local to it.
struct PatchSolution {
  std::vector<int> places;  ///< that were measured
  /// Weights of the places in the least-energy values of the asked functions: functions x places. Empty if the
  /// measurements do not fix the null space of the patch's energy.
  Eigen::MatrixXd weights;
};
/// `functions` (numbers on the fine level) must not be private and must be local to the patch.
PatchSolution solve_patch(const PatchedStep& step, const Patch& patch, const std::vector<int>& functions);

}  // namespace batten
