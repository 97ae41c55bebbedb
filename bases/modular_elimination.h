// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace batten {

/// The inverse of a modulo a prime that does not divide it.
std::uint32_t inverse_modulo(std::uint64_t a, std::uint32_t prime);

/// Gaussian elimination modulo a prime below 2^26, one row at a time: rows that depend on earlier ones are dropped, the
/// others are kept as L U. Kept rows are numbered in the order in which they came.
class ModularElimination {
public:
  ModularElimination(int unknowns, std::uint32_t prime);

  /// A row, dense, its entries below the prime. Whether it does not depend on the rows kept so far, and is kept.
  bool add(std::span<const std::uint32_t> row);
  int rank() const { return static_cast<int>(rows_.size()); }
  bool is_full() const { return rows_.size() == row_of_column_.size(); }
  /// The solution for a right side of the kept rows. Precondition: is_full().
  std::vector<std::uint32_t> solve(std::span<const std::uint32_t> right) const;

private:
  /// row = Σ_k multipliers.second · upper(multipliers.first) + pivot · (x_column + Σ_j upper[j] x_(column + 1 + j))
  struct Row {
    std::size_t column;
    std::uint32_t inverse_pivot;
    std::vector<std::pair<std::size_t, std::uint32_t>> multipliers;
    std::vector<std::uint32_t> upper;
  };
  void keep(std::size_t column, std::vector<std::pair<std::size_t, std::uint32_t>> multipliers);

  std::uint32_t prime_;
  std::vector<Row> rows_;
  std::vector<std::ptrdiff_t> row_of_column_;  ///< -1 where no row has its pivot
  std::vector<std::uint64_t> work_;
};

}  // namespace batten
