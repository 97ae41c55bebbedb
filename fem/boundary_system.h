// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_problem.h>
#include <batten/fem/multigrid.h>

#include <optional>
#include <span>
#include <vector>

namespace batten {

/// The discrete form of a boundary value problem: A v = b on the splines that keep the homogeneous side conditions, and
/// the way to all splines of the problem's degree ("whole" coefficients).
///
/// A is the energy of the material plus `mass` times the identity in L2. Values inside the rectangle are held by
/// springs Σ_i w_i b_i b_i^T on top of A, which `solve_boundary_problem` makes exact.
class BoundarySystem {
public:
  /// Values prescribed at points.
  struct Constraints {
    std::vector<double> x, y, target;
    std::size_t size() const { return x.size(); }
  };

  explicit BoundarySystem(const BoundaryProblem& problem, const Field& mass = 0, const Constraints& constraints = {});
  BoundarySystem(const BoundarySystem&) = delete;
  BoundarySystem& operator=(const BoundarySystem&) = delete;

  const Hierarchy& hierarchy() const { return hierarchy_; }
  const SplineSpace& space() const { return hierarchy_.finest().space; }
  const Multigrid& multigrid() const { return multigrid_; }
  /// The index, among the constraints given, of each point of multigrid().data().
  const std::vector<std::size_t>& order() const { return order_; }

  /// A v on the splines that keep the side conditions, without springs.
  std::vector<double> apply(std::span<const double> v) const;
  /// A of all splines, without springs, for whole coefficients: by differences first where coefficients are constant,
  /// so that it keeps its digits on fine grids.
  /// `memory` is used for the result, here and below.
  std::vector<double> apply_whole(std::span<const double> whole, std::vector<double> memory = {}) const;
  /// T^T b: a load vector of all splines, restricted to those that keep the conditions.
  std::vector<double> restricted(std::span<const double> whole, std::vector<double> memory = {}) const;
  /// T v: the whole coefficients of a spline that keeps the conditions.
  std::vector<double> whole(std::span<const double> v) const;

private:
  SplineSpace whole_space_;
  std::optional<Energy> constant_energy_;
  Operator whole_energy_;
  Hierarchy hierarchy_;
  GridPoints points_;
  std::vector<std::size_t> order_;
  Multigrid multigrid_;
};

/// A of all splines, neither springs nor mass added.
Operator whole_energy(const BoundaryProblem& problem);
/// The same of the splines that keep the side conditions; `whole` is that of all splines.
Operator restricted_energy(const BoundaryProblem& problem, const Operator& whole);

}  // namespace batten
