// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/streamed_smoother.h>

#include <span>
#include <vector>

namespace batten {

/// StreamedSmoother for degree 1, with the same polynomials.
///
/// Nine weights of a row are all that the operator has inside, so a step is one sweep over a row: with M the diagonal
/// behind the polynomial and gain g,
///
///   x_k = x_k-1 + keep (x_k-1 - x_k-2) + g M^-1 (b - A x_k-1)
///
/// reads three rows of x_k-1 and one of b and x_k-2 and writes one. Residuals are formed anew from b and x. Columns at
/// the ends, where weights differ, follow one by one. Panels are as wide as the second-level cache allows: the rows of
/// one are then long enough for the processor to foresee.
class BilinearSmoother {
public:
  /// `steps` applications of A before and after; a single one before only. The level, of degree 1, is kept by
  /// reference.
  BilinearSmoother(const Hierarchy::Level& level, int steps, double lambda);

  using Start = StreamedSmoother::Start;
  using Rings = StreamedSmoother::Rings;

  /// As those of StreamedSmoother.
  double descend(const Start& start, std::span<const double> b, std::span<double> x, std::span<double> coarse_right,
                 bool measure, Rings& rings) const;
  void ascend(std::span<const double> x, std::span<const double> coarse, std::span<const double> b,
              std::span<double> out, Rings& rings) const;

  struct Turn {
    double product = 0;  ///< what `descend` returns
    double work = 0;     ///< b·s of its start s
  };
  /// `ascend` and, from its result, `descend` in one pass, which spares writing the result and reading it and b again.
  /// out must not overlap x.
  Turn turn(std::span<const double> x, std::span<const double> coarse, std::span<const double> b, std::span<double> out,
            std::span<double> coarse_right, Rings& rings) const;

private:
  struct Job;
  class Block;
  void run(const Job& job, Rings& rings) const;
  Turn sum() const;
  void set_weights();

  const Hierarchy::Level* level_;
  double lambda_;
  std::vector<ChebyshevStep> steps_;
  RepeatedRows inverse_;            // of M
  std::vector<int> end_columns_;    // whose weights differ
  RepeatedRows weights_;            // of rows of λ E: near and far ones and M^-1 inside, nine for each end column
  mutable std::vector<Turn> sums_;  // by row and panel
};

}  // namespace batten
