// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/boundary_problem.h>
#include <batten/fem/hierarchy.h>

#include <span>
#include <variant>
#include <vector>

namespace batten {

/// The inner product ∫∫ density u v of the splines that keep the side conditions of a problem, in its units: exact
/// inner products of one variable for a constant density, a symmetric stencil for others.
class Mass {
public:
  /// On the finest level. Throws InvalidInput unless density > 0 everywhere.
  Mass(const BoundaryProblem& problem, const Field& density);
  /// On the level below `finer`.
  Mass coarser(const Hierarchy::Level& finer, const Hierarchy::Level& coarse) const;

  /// out = M v. On a periodic space v has its images, out holds nothing there.
  void apply(std::span<const double> v, std::span<double> out) const;

private:
  Mass(const SplineSpace& space, std::variant<TensorSum, SymmetricStencil> matrix)
      : space_(space), matrix_(std::move(matrix)) {}
  SplineSpace space_;
  std::variant<TensorSum, SymmetricStencil> matrix_;
};

/// c = M^-1 b for the density 1: two banded matrices of one variable are factored. Of periodic directions the matrix is
/// taken without its corners, which leaves a good preconditioner: see is_exact.
class MassInverse {
public:
  explicit MassInverse(const SplineSpace& space, const Rectangle& region);

  /// Replaces b by M^-1 b; 0 for functions that the side conditions take away.
  void apply(std::span<double> b) const;
  bool is_exact() const { return !space_.is_periodic(); }

private:
  /// L D L^T, L with unit diagonal: entry k of row i belongs to column i - degree + k, the last one is 1 / D_ii.
  struct Factor {
    int size, degree;
    std::vector<double> rows;
    Factor(const SplineBasis& basis, double unit);
    /// Solves for `lanes` neighbouring right-hand sides; the entries of each are `stride` apart.
    void solve(double* b, std::ptrdiff_t stride, int lanes) const;
  };
  SplineSpace space_;
  Factor x_, y_;
};

}  // namespace batten
