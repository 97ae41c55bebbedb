// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

namespace batten {

/// A banded matrix in one dimension, by rows: row i holds `width` weights for the columns first[i] .. first[i] + width
/// - 1, and the matrix is `scale` times those weights. Inner products, refinement and its transpose, and sampling of
/// splines all have this form; in two dimensions they act as Kronecker products Y ⊗ X (see tensor_product.h).
///
/// Rows begin .. end-1 repeat: row i + period has the weights of row i, with its columns moved by `shift`.
/// Weights of inner products are integers and `scale` is 1 / (common denominator) where the integers fit into a double.
struct BandedRows {
  int rows = 0;
  int columns = 0;
  int width = 0;
  double scale = 1;
  std::vector<int> first;
  std::vector<double> weights;  ///< rows x width, row after row
  int begin = 0;                ///< first repeating row
  int end = 0;                  ///< one past the last repeating row
  int period = 1;
  int shift = 1;

  std::span<const double> row(int i) const {
    return {weights.data() + static_cast<std::size_t>(i) * static_cast<std::size_t>(width),
            static_cast<std::size_t>(width)};
  }
  /// Entry (i, j), zero outside the band.
  double operator()(int i, int j) const {
    const int k = j - first[static_cast<std::size_t>(i)];
    return k < 0 || k >= width ? 0. : scale * row(i)[static_cast<std::size_t>(k)];
  }
};

/// Sets begin and end to the longest run around the middle row that repeats with the matrix's period and shift.
void find_repeating_rows(BandedRows& matrix);

/// The transposed matrix, its repeating rows found anew where `period` and `shift` are 1.
BandedRows transposed(const BandedRows& matrix);

/// The identity.
BandedRows identity_rows(int size);

}  // namespace batten
