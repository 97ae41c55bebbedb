// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_problem.h>
#include <batten/fem/hierarchy.h>

#include <string>
#include <vector>

namespace batten {

/// What the sides ask of the homogeneous part of the solution: values are fixed strongly, normal derivatives of plates
/// too, while those of Conduction are loads. Throws InvalidInput where one of two opposite sides is periodic alone, or
/// prescribes something.
SpaceEnds side_conditions(const BoundaryProblem& problem);

/// A spline that takes the data of the sides: coefficients in the whole spline space, x fastest.
struct Lifting {
  std::vector<double> coefficients;
  std::vector<std::string> notes;  ///< where data differ at a corner, or between periodic sides
};

/// Each side's value and normal derivative are projected onto the splines of that side (L2, the ends of values
/// interpolated), and determine the first coefficients from there, those further inside are blended between the sides.
/// Where values of two sides differ at a corner the coefficient takes their mean. Slopes give way to values, and those
/// of sides that have both are projected at once, as two sides share a coefficient near a corner. Throws InvalidInput
/// for data that are not finite.
Lifting lifting(const BoundaryProblem& problem);

}  // namespace batten
