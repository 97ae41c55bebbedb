// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_system.h>
#include <batten/fem/projected_gradients.h>
#include <batten/fem/support_projection.h>

#include <Eigen/Core>

#include <span>
#include <vector>

namespace batten {

/// Solves K s = b, K = A + mass in L2, on the splines that keep the side conditions and vanish at the supports, for one
/// right-hand side after the other: all stages of all steps of an implicit method.
///
/// Each solve starts from the combination of the last few solutions that is nearest in the norm of K [Fischer 1998]: as
/// good as extrapolation where motion is smooth, and never worse than 0.
class ShiftedSolver {
public:
  ShiftedSolver(const BoundaryProblem& problem, const Field& mass, const BoundarySystem::Constraints& constraints,
                const IterationLimits& limits);
  ShiftedSolver(const ShiftedSolver&) = delete;
  ShiftedSolver& operator=(const ShiftedSolver&) = delete;

  const BoundarySystem& system() const { return system_; }
  const SupportProjection& projection() const { return projection_; }

  /// The error of s in the norm of K is at most limits.accuracy * scale; a scale of 0 stands for the norm of s. Valid
  /// until the next solve.
  std::span<const double> solve(std::span<const double> b, double scale);
  /// The s of the last solve, scaled so that its residual b - K s is orthogonal to it.
  std::span<const double> balanced(std::span<const double> b);
  int cycles() const { return cycles_; }

private:
  void start(std::span<const double> b);
  void remember(std::span<const double> b);

  BoundarySystem system_;
  SupportProjection projection_;
  IterationLimits limits_;
  ProjectedGradients gradients_;
  std::vector<double> s_;
  Eigen::MatrixXd solutions_, products_;  // the last few s, and K s
  Eigen::Index kept_ = 0, next_ = 0;
  int cycles_ = 0;
};

}  // namespace batten
