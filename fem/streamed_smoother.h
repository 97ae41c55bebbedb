// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/repeated_rows.h>
#include <batten/fem/chebyshev_step.h>
#include <batten/fem/hierarchy.h>

#include <span>
#include <vector>

namespace batten {

/// Chebyshev smoothing of A = λ E, constant coefficients and no data, with nothing of its own in memory.
///
/// It is the plain form of Smoother, with the same polynomials. Everything between a right-hand side that is read and a
/// result that is written lives in rings of rows: row j of a step needs rows j - d .. j + d of the one before, so that
/// step s follows s d rows behind the front and a few rows of each vector suffice. Each thread has one block of rows
/// and works beyond its ends as far as its own rows need it, twice as it were; no row depends on where the blocks end.
/// (With data, points add to rows of whole vectors: that is why Smoother has vectors.)
class StreamedSmoother {
public:
  /// `steps` applications of A before and after; a single one before only. The level is kept by reference.
  StreamedSmoother(const Hierarchy::Level& level, int steps, double lambda);

  /// Where the smoothing starts: at 0, at `given`, or at the solution of the coarser level, refined by `refinement`.
  struct Start {
    const double* given = nullptr;
    const double* coarse = nullptr;
    const TensorSum* refinement = nullptr;
  };
  /// Rows on their way, for each thread.
  using Rings = std::vector<std::vector<double>>;

  /// x = s + p(A) (b - A s) for the start s, and coarse_right = R^T (b - A x). Returns (x - s)·((b - A s) + (b - A x)),
  /// this level's part of r·Br, if `measure` is set. x must not overlap the start.
  double descend(const Start& start, std::span<const double> b, std::span<double> x, std::span<double> coarse_right,
                 bool measure, Rings& rings) const;
  /// out = y + p(A) (b - A y), y = x + R coarse. out must not overlap x.
  void ascend(std::span<const double> x, std::span<const double> coarse, std::span<const double> b,
              std::span<double> out, Rings& rings) const;

private:
  struct Job;
  class Block;
  void run(const Job& job, Rings& rings) const;

  const Hierarchy::Level* level_;
  double lambda_;
  std::vector<ChebyshevStep> steps_;
  RepeatedRows inverse_;              // of D
  int panels_;                        // parts of the columns, one after another: the rings of one fit in the cache
  mutable std::vector<double> sums_;  // of products, by row and panel
};

}  // namespace batten
