// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace batten {

/// The thin plate of least bending energy ∫ p_xx² + 2 p_xy² + p_yy² over the plane through scattered points,
/// p(x) = Σ_i a_i c_2(x - x_i) + a linear polynomial, c_2 = r² log(r²) / (16π), where Σ a_i = 0 and Σ a_i x_i = 0
/// [Duchon 1977; Warren & Weimer 2001, sec. 5.1.2]. By dense elimination: n³ operations for n points, a reference for
/// small data.
class ThinPlateInterpolant {
public:
  /// A point in each row. Throws InvalidInput when the numbers of points and values differ, one is not finite, there
  /// are fewer than three points, all are on a line, or two are the same; SolverError when points are so close to each
  /// other that the interpolant misses the values by more than 1e-8 of the largest.
  ThinPlateInterpolant(const Eigen::Ref<const Eigen::MatrixX2d>& points,
                       const Eigen::Ref<const Eigen::VectorXd>& values);

  double value(double x, double y) const;
  Eigen::Vector2d gradient(double x, double y) const;
  /// a_i, in the units of value / length².
  Eigen::VectorXd weights() const { return weights_ / (scale_ * scale_); }

private:
  Eigen::Vector2d normalised(double x, double y) const;

  Eigen::RowVector2d centre_;
  double scale_;             // length of one unit within
  Eigen::MatrixX2d points_;  // normalised
  Eigen::VectorXd weights_;  // of the normalised points
  Eigen::Vector3d linear_;   // of 1, x, y, normalised
};

}  // namespace batten
