// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/bilinear_smoother.h>
#include <batten/fem/cubic_refinement.h>
#include <batten/fem/sparse_cholesky.h>
#include <batten/fem/streamed_smoother.h>

#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace batten {

/// V-cycles for A = λ E with constant coefficients and no data, which need little memory: the finest level has one
/// vector besides the solution and the right-hand side, each coarse level three in all.
class StreamedCycle {
public:
  /// The hierarchy and the factor of the coarsest level's matrix are kept by reference.
  StreamedCycle(const Hierarchy& hierarchy, int steps, double lambda, const SparseCholesky& coarsest);

  /// out = s + B (b - A s) for the start s, B one V-cycle from this level down. `out` may be the start.
  void improve(std::size_t level, const StreamedSmoother::Start& start, std::span<const double> b,
               std::span<double> out) const {
    improve(Kind::Symmetric, level, start, b, out);
  }
  /// The same for the finest level and the start c. Returns sqrt(r·Br), r = b - A c: the start's error in the energy
  /// norm, as B sees it. Where that is at most `enough`, the second half of the cycle is saved and c left as it is.
  double improve_unless(double enough, std::span<const double> b, std::span<double> c) const;

  /// Full multigrid from nothing, one V-cycle on each level: the error that is left is smaller than that of the
  /// discretisation. For degree 1 these cycles have one step before and all after, which leaves as little of the error
  /// of waves as cycles with all steps before as well.
  void solve_by_levels(std::span<const double> b, std::span<double> c) const;
  /// Its work, in V-cycles on the finest level.
  double work_by_levels() const;

private:
  using AnySmoother = std::variant<StreamedSmoother, BilinearSmoother>;
  struct Level {
    AnySmoother smoother;
    std::optional<AnySmoother> first;      // the one before, by levels, if set
    std::optional<TensorSum> cubic;        // for the start by the next coarser level, if set
    std::vector<double> right, middle, x;  // right-hand side, what the first half of a cycle leaves, solution
  };

  enum class Kind { Symmetric, ByLevels };
  static AnySmoother smoother_of(const Hierarchy::Level& level, int steps, double lambda);
  double correct(Kind kind, std::size_t level, const StreamedSmoother::Start& start, std::span<const double> b,
                 bool measure) const;
  void ascend(std::size_t level, std::span<const double> b, std::span<double> out) const;
  void improve(Kind kind, std::size_t level, const StreamedSmoother::Start& start, std::span<const double> b,
               std::span<double> out) const;

  const Hierarchy* hierarchy_;
  const SparseCholesky* coarsest_;
  mutable std::vector<Level> levels_;
  mutable StreamedSmoother::Rings rings_;
};

}  // namespace batten
