// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

namespace batten {

/// Symmetric weights W of the rows of a ConstrainedEnergy, block by block: blocks of `together` rows that follow each
/// other.
struct RowWeights {
  int together = 1;
  std::vector<double> diagonal;  ///< positive
  std::vector<double> beside;    ///< entries (0,1), (0,2), (1,2) of each block, as far as it has them
};

/// A convex energy J(c) = ½ c·Qc - q·c + constant of coefficients c, and the rows B whose values B c are constrained:
/// what the interior-point method asks of a discretisation, which keeps c and a direction dc. Forces act along rows:
/// Bᵀ f.
class ConstrainedEnergy {
public:
  virtual ~ConstrainedEnergy() = default;

  virtual std::size_t rows() const = 0;
  /// B c
  virtual std::vector<double> values() const = 0;
  /// J(c)
  virtual double energy() const = 0;
  /// Makes dc from now on the solution of Q (c + dc) - q = Bᵀ (f - W B dc), and returns B dc. `accuracy`: asked
  /// relative error in the energy norm. Directions of the same weights follow each other: the last one is a start.
  virtual std::vector<double> direction(const RowWeights& weights, std::span<const double> force, double accuracy) = 0;
  /// c += step dc
  virtual void advance(double step) = 0;
  /// min over all c of J(c) - f·B c, from below. That is finite for forces that do no work on functions without energy
  /// only: they are changed first, by as little as makes them so, along the rows that weigh most in the last direction.
  virtual double bound(std::span<double> force) = 0;
};

}  // namespace batten
