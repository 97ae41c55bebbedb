// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_problem.h>
#include <batten/fem/hierarchy.h>

#include <Eigen/Dense>

#include <array>
#include <span>
#include <vector>

namespace batten {

/// The functions without energy that the sides and supports of a problem leave free: combinations of 1, s and t, with s
/// and t from -1 to 1 over the rectangle.
class RigidMotions {
public:
  explicit RigidMotions(const BoundaryProblem& problem);

  int count() const { return static_cast<int>(motions_.cols()); }
  /// Their coefficients in splines without conditions, of any level: size() x count().
  Eigen::MatrixXd functions(const SplineSpace& space) const;
  /// Places (x, y), as many as motions, at which the values of a motion determine it.
  std::vector<std::array<double, 2>> pins() const;
  /// Throws InvalidInput if the load vector b does work on a motion: says by how much force and moment.
  void expect_balanced(std::span<const double> b) const;
  /// Adds the motion that makes ∫∫ u m = 0 for every motion m.
  void remove_from(std::span<double> coefficients) const;

private:
  Rectangle region_;
  int degree_;
  bool plate_;
  Eigen::MatrixXd motions_;  // 3 x count(): weights of 1, s, t; orthonormal columns
};

}  // namespace batten
