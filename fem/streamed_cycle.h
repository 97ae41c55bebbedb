// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/bilinear_smoother.h>
#include <batten/fem/cubic_refinement.h>
#include <batten/fem/sparse_cholesky.h>
#include <batten/fem/streamed_smoother.h>

#include <functional>
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
  /// What is known of an approximate solution s, in the energy norm.
  struct Iterate {
    double error = 0;  ///< sqrt(r·Br), r = b - A s: its error, as B sees it
    double size = 0;   ///< sqrt(b·s): its own where it is near the solution; 0 for a start that is given
  };
  enum class Begin { AtStart, ByLevels };
  /// V-cycles on the finest level, one after another, from the start c or from what solve_by_levels finds. Calls
  /// `goes_on` with each iterate and stops where that says no; c receives this iterate or one with less of the error.
  void iterate(Begin begin, std::span<const double> b, std::span<double> c,
               const std::function<bool(const Iterate&)>& goes_on) const;

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
                 std::span<double> middle, bool measure) const;
  double correct_coarse(Kind kind, std::size_t level, bool measure) const;
  void ascend(std::size_t level, std::span<const double> middle, std::span<const double> b,
              std::span<double> out) const;
  void descend_by_levels(std::span<const double> b, std::span<double> middle) const;
  StreamedSmoother::Start start_by_levels(std::size_t level) const;
  Iterate turn(std::span<const double> b, std::span<double>& middle, std::span<double>& other) const;
  void improve(Kind kind, std::size_t level, const StreamedSmoother::Start& start, std::span<const double> b,
               std::span<double> out) const;

  const Hierarchy* hierarchy_;
  const SparseCholesky* coarsest_;
  mutable std::vector<Level> levels_;
  mutable StreamedSmoother::Rings rings_;
};

}  // namespace batten
