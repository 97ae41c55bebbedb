// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/constrained_energy.h>
#include <batten/fem/penalised_problem.h>

#include <utility>
#include <vector>

namespace batten {

/// J(c) = ½ c·E c + ½ Σ_i fixed_i (value_i - (B c)_i)² of the splines on a grid. Rows are the measurements, in the
/// order of the grid; directions are solutions of its multigrid.
class GridEnergy : public ConstrainedEnergy {
public:
  /// `fixed`: weights of measurements, not negative; none where empty. The problem is kept by reference, and its λ and
  /// weights change.
  GridEnergy(PenalisedProblem& problem, std::vector<double> fixed, std::vector<double> start);
  /// Rows are the measurements over these factors, all positive, from now on.
  void divide_rows(std::vector<double> factors) { factors_ = std::move(factors); }

  std::size_t rows() const override { return problem_.size(); }
  std::vector<double> values() const override { return rows_of(problem_.values(c_)); }
  double energy() const override { return energy_of(c_); }
  std::vector<double> direction(const RowWeights& weights, std::span<const double> force, double accuracy) override;
  /// B A^-1 Bᵀ force with A = Q + Bᵀ W B: how measurements give way.
  std::vector<double> response(const RowWeights& weights, std::span<const double> force, double accuracy);
  void advance(double step) override;
  double bound(std::span<double> force) override;

  const std::vector<double>& coefficients() const { return c_; }
  /// V-cycles spent, in units of this grid's.
  int cycles() const { return cycles_; }

private:
  /// Numbers of measurements over the factors: values as rows, forces on rows as forces on measurements.
  std::vector<double> rows_of(std::vector<double> numbers) const;
  /// c·Q c / 2 - q·c + constant
  double energy_of(std::span<const double> c) const;
  /// q - Q c + Bᵀ force
  std::vector<double> pull(std::span<const double> force) const;
  /// Sets the problem to (stiffness Q + Bᵀ W B) / unit, and returns the unit.
  double set(const RowWeights& weights, double stiffness);
  double solve(std::span<const double> b, std::span<double> c, double accuracy);

  PenalisedProblem& problem_;
  std::vector<double> fixed_, factors_, c_, dc_;
  RowWeights weights_;  // of the last direction
  int cycles_ = 0;
};

}  // namespace batten
