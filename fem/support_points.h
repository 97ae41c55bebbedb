// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_system.h>
#include <batten/fem/solution.h>

#include <array>
#include <vector>

namespace batten {

/// The points at which the supports of a problem prescribe values.
struct SupportPoints {
  BoundarySystem::Constraints constraints;
  std::vector<std::size_t> owner;  ///< of each point: the support, points first, then lines, then pins
};

/// Points of supports: a point is itself, a peg the points of its disc one cell apart and of its circle, a line points
/// one cell apart with both ends. Pins hold the value 0. Points that a side or another support fixes already are left
/// out. Throws InvalidInput for supports outside of the rectangle, for a point support of a Conduction problem without
/// radius, and for two supports that ask different values of one place.
SupportPoints support_points(const BoundaryProblem& problem, const std::vector<std::array<double, 2>>& pins);

/// What a spline misses of the prescribed values, in the order of the system's points (BoundarySystem::order).
std::vector<double> missing_values(const BoundarySystem::Constraints& constraints,
                                   const std::vector<std::size_t>& order, const Solution& spline);

}  // namespace batten
