// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/null_projection.h>
#include <batten/fem/smoother.h>

#include <span>
#include <vector>

namespace batten {

/// The system A = λ E + B^T W B of a penalised least-squares fit and its multigrid preconditioner.
///
/// One V-cycle with equal Chebyshev smoothing before and after, so that it is a symmetric positive definite operator.
/// Transfers are B-spline refinement. The energy on coarse levels is exact. Where the data are stiff compared with the
/// energy, the finest level smooths data-aware and each coarser level sees its points on springs in series, 1/w_i <-
/// 1/w_i + comp_i with the compliance of the level above: what a point asks of a coarse function, the finer level can
/// give by bending near that point. The number of iterations then depends neither on λ nor on the size.
class Multigrid {
public:
  /// Both are kept by reference and must outlive this object.
  Multigrid(const Hierarchy& hierarchy, const GridPoints& points);

  /// Weights in the order of the points, all positive; λ > 0.
  void set(double lambda, std::span<const double> weights);

  const Hierarchy& hierarchy() const { return *hierarchy_; }
  const DataTerm& data() const { return levels_.front().data(); }
  double lambda() const { return levels_.front().lambda(); }
  std::size_t size() const { return levels_.front().size(); }
  /// True if the finest level smooths data-aware.
  bool is_data_aware() const { return data_aware_; }

  /// out = A c on the finest level.
  void apply(std::span<const double> c, std::span<double> out) const { levels_.front().apply(c, out); }
  /// out = V-cycle applied to r. For a very large λ it acts in the complement of the null space of the energy.
  void precondition(std::span<const double> r, std::span<double> out) const;

  /// Set for a very large λ only: `solve` finds the component in the null space from it.
  const std::optional<NullProjection>& null_projection() const { return null_projection_; }

private:
  void cycle(std::size_t level) const;
  void factor_coarsest();
  bool can_be_data_aware() const;

  const Hierarchy* hierarchy_;
  std::vector<Smoother> levels_;
  std::optional<SparseCholesky> coarsest_;
  std::optional<NullProjection> null_projection_;
  mutable std::vector<Smoother::Work> work_;
  int degree_;  // of the smoothing polynomials
  bool data_aware_ = false;
};

}  // namespace batten
