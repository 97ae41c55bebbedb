// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/grid_samples.h>
#include <batten/fem/spline_level.h>

namespace batten {

/// The array "value": a spline on a uniform rectangle at the corners of its cells; not a number where no cell of the
/// domain is near. Throws InvalidInput for intervals and uneven cells, and when the coefficients do not fit.
GridSamples corner_samples(const SplineLevel& level, const Eigen::VectorXd& coefficients);

}  // namespace batten
