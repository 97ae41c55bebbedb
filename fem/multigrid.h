// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/null_projection.h>
#include <batten/fem/smoother.h>
#include <batten/fem/streamed_cycle.h>

#include <optional>
#include <span>
#include <vector>

namespace batten {

/// The system A = λ E + B^T W B of a penalised least-squares fit and its multigrid preconditioner.
///
/// One V-cycle with equal Chebyshev smoothing before and after, so that it is a symmetric positive definite operator.
/// Where the coefficients of the energy vary, coarse levels are visited twice (a W-cycle): transfers do not know of
/// jumps of the coefficients, and with one visit the number of iterations would grow by one or two with each level.
/// Transfers are B-spline refinement. The energy on coarse levels is exact. Where the data are stiff compared with the
/// energy, the finest level smooths data-aware and each coarser level sees its points on springs in series, W^-1 <-
/// W^-1 + diag(comp) with the compliance of the level above: what a point asks of a coarse function, the finer level
/// can give by bending near that point. The number of iterations then depends neither on λ nor on the size. Without
/// points and with constant coefficients the V-cycle is the one of StreamedCycle.
class Multigrid {
public:
  /// Both are kept by reference and must outlive this object.
  Multigrid(const Hierarchy& hierarchy, const GridPoints& points);

  /// Weights in the order of the points, all positive, and what stands beside them, as of PairWeights; λ > 0.
  void set(double lambda, std::span<const double> weights, std::span<const double> beside = {});

  const Hierarchy& hierarchy() const { return *hierarchy_; }
  const DataTerm& data() const { return levels_.front().data(); }
  double lambda() const { return lambda_; }
  /// Levels are numbered from the finest, 0.
  std::size_t levels() const { return levels_.size(); }
  std::size_t size(std::size_t level = 0) const { return levels_[level].size(); }
  /// True if the finest level smooths data-aware.
  bool is_data_aware() const { return data_aware_; }
  /// True if the solution of coarser levels is a sound start: they see the same data, and the rounding of λ E leaves
  /// the component in its null space alone, which the right-hand side does not hold.
  bool can_predict() const { return can_predict_; }

  /// out = A c on a level. Returns c · A c.
  double apply(std::span<const double> c, std::span<double> out, std::size_t level = 0) const {
    return levels_[level].apply(c, out);
  }
  /// out = V-cycle from this level down, applied to r; the direct solution on the coarsest. For a very large λ it acts
  /// in the complement of the null space of the energy.
  void precondition(std::span<const double> r, std::vector<double>& out, std::size_t level = 0) const;

  /// The parts that cycles of coupled systems are made of. Without points levels have no buffers.
  const Smoother& level(int k) const { return levels_[static_cast<std::size_t>(k)]; }
  Smoother::Work& work(int k) const { return work_[static_cast<std::size_t>(k)]; }
  int smoothing_degree() const { return degree_; }

  /// Set where the system is λ E with constant coefficients and nothing else.
  const StreamedCycle* streamed() const { return streamed_ ? &*streamed_ : nullptr; }

  /// The vectors of conjugate gradients on a level, kept from solve to solve: to touch fresh memory takes as long as an
  /// iteration.
  struct Vectors {
    std::vector<double> r, z, p, q;
  };
  Vectors& vectors(std::size_t level) const { return vectors_[level]; }

  /// Set for a very large λ only: `solve` finds the component in the null space from it.
  const std::optional<NullProjection>& null_projection() const { return null_projection_; }

private:
  void cycle(std::size_t level, std::span<const double> r) const;
  void cycle_twice(std::size_t level) const;
  void factor_coarsest();
  bool can_be_data_aware() const;

  const Hierarchy* hierarchy_;
  bool streams_;  // no points, constant coefficients
  std::vector<Smoother> levels_;
  std::optional<SparseCholesky> coarsest_;
  std::optional<StreamedCycle> streamed_;
  std::optional<NullProjection> null_projection_;
  mutable std::vector<Smoother::Work> work_;
  mutable std::vector<Vectors> vectors_;
  struct Repeat {
    std::vector<double> right, first;  ///< the right-hand side of a level and its first solution
  };
  mutable std::vector<Repeat> repeat_;  // of coarse levels that are visited twice
  int degree_;                          // of the smoothing polynomials
  bool repeats_;                        // coarse levels are visited twice
  bool grounded_;           // no equation knows the constant: on the coarsest level one coefficient is held at 0 ...
  std::size_t ground_ = 0;  // ... the first
  double lambda_ = 0;       // none is set
  bool data_aware_ = false;
  bool can_predict_ = false;
};

}  // namespace batten
