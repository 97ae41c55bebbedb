// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

namespace batten {

/// Points of a curve as numbers of size 1: mean cells 1 wide, the points less their line of regression or their mean
/// and over their range, the largest that a component has; 1 where all points are the same. What a spline's
/// values v stand for is line + range v, its p'' of these v range / cell² times that.
struct NormalisedCurve {
  enum class Less { Line, Mean };
  NormalisedCurve(const std::vector<double>& knots, const Eigen::MatrixXd& points, Less less);

  /// Numbers back in the data's units, a row for each knot.
  Eigen::MatrixXd values(const std::vector<double>& normalised) const;
  Eigen::MatrixXd second_derivatives(const std::vector<double>& normalised) const;
  /// ½ ∫ |p''|² of normalised cells for ∫ |p''|² of values over their range and parameters from 0 to 1.
  double normalised_energy(double energy) const;
  double energy_of(double normalised) const;

  int dimension;
  double range, cell;
  std::vector<double> widths;
  std::vector<double> places;  ///< of the points, -1 to 1
  std::vector<double> points;  ///< component by component of each
  Eigen::MatrixXd line;        ///< value in the middle and half of the difference of the ends, each a row
};

}  // namespace batten
