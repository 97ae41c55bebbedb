// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/SparseCore>

#include <cstddef>
#include <span>
#include <vector>

namespace batten {

/// The symmetric weights W of rows: a diagonal, or where rows 2k and 2k + 1 belong together, as those of a vector do,
/// blocks [[w_2k, x_k], [x_k, w_2k+1]].
struct PairWeights {
  std::vector<double> diagonal;
  std::vector<double> beside;  ///< x of each pair; empty: none

  PairWeights() = default;
  /// Blocks that are all but singular are kept from it: |x_k| <= (1 - 1e-13) sqrt(w_2k w_2k+1), so that W^-1 can be
  /// formed. Throws InvalidInput for numbers beside that are not one for each pair, or make a block indefinite.
  explicit PairWeights(std::span<const double> diagonal, std::span<const double> beside = {});
  bool operator==(const PairWeights&) const = default;

  std::size_t size() const { return diagonal.size(); }
  bool are_paired() const { return !beside.empty(); }
  /// W_ij
  double entry(std::size_t i, std::size_t j) const {
    if (i == j) return diagonal[i];
    return are_paired() && i / 2 == j / 2 ? beside[i / 2] : 0;
  }
  /// v <- W v
  void multiply(std::span<double> v) const;
  /// F W F with the diagonal matrix F.
  PairWeights scaled(std::span<const double> factor) const;
  /// The diagonal of a matrix that is at least W: 2 |x| a b <= |x| (t a² + b² / t) with t = sqrt(w_2k / w_2k+1), which
  /// exceeds W's own by less than twice.
  std::vector<double> lumped() const;
  PairWeights inverse() const;
  /// W <- (W^-1 + diag(give))^-1: springs in series.
  void soften(std::span<const double> give);
};

/// Adds the lower triangle of W to a matrix.
void add_lower_triangle(const PairWeights& weights, Eigen::SparseMatrix<double>& matrix);

}  // namespace batten
