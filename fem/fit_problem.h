// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/conjugate_gradients.h>
#include <batten/fem/fit.h>
#include <batten/fem/null_space.h>
#include <batten/fem/penalised_problem.h>

#include <memory>
#include <vector>

namespace batten {

/// The observations of a fit in the scale that the solver works with.
struct FitData {
  std::vector<double> x, y;         ///< in the observations' own units
  std::vector<double> value;        ///< (z - null element) / scale
  std::vector<Measured> kind;       ///< of the spline or which derivative; empty: all are values
  double spacing = 1;               ///< where coefficients are measured, that of their knots, in cells
  std::vector<double> weight;       ///< sum 1, all positive
  std::vector<std::size_t> source;  ///< index among the observations (the first of merged ones)
  LinearFunction null_element;      ///< of the observations, in x and y
  double scale = 1;                 ///< range of the observed values
  double total_weight = 1;          ///< sum of the observations' own weights
  std::size_t size() const { return value.size(); }
};

/// Checks the observations, leaves out those outside the region and those of weight 0, orders and scales the rest. With
/// `merge_coincident` observations at the same place become one, of their mean value and summed weight.
/// Throws InvalidInput as fit_surface does.
struct PreparedData {
  FitData data;
  std::size_t outside = 0;
  std::size_t merged = 0;
};
PreparedData prepare(const Observations& observations, const Rectangle& region, const Energy& energy,
                     bool merge_coincident);

/// The penalised least-squares problem of one spline on one grid, with or without conditions at its sides: the data
/// ordered by its cells, the levels and the solver.
class FitProblem : public PenalisedProblem {
public:
  /// Of the options the energy, degree and aspect. The data are kept by reference.
  FitProblem(const FitData& data, const Rectangle& region, const FitOptions& options, const SpaceEnds& ends = {});
  FitProblem(const FitProblem&) = delete;
  FitProblem& operator=(const FitProblem&) = delete;

  const Hierarchy& hierarchy() const { return hierarchy_; }
  Multigrid& system() { return system_; }
  const Multigrid& system() const { return system_; }
  const GridPoints& points() const { return points_; }  ///< ordered by cell
  /// All splines of the finest level, without conditions at its sides.
  SplineSpace whole_space() const;

  const Rectangle& region() const override { return hierarchy_.region(); }
  std::size_t unknowns() const override { return system_.size(); }
  const std::vector<double>& value() const override { return value_; }
  const std::vector<double>& weight() const override { return weight_; }
  const std::vector<std::size_t>& order() const override { return order_; }
  using PenalisedProblem::set;
  void set(double lambda, std::span<const double> weights, std::span<const double> beside) override {
    system_.set(lambda, weights, beside);
  }
  bool can_predict() const override { return system_.can_predict(); }
  double apply(std::span<const double> c, std::span<double> out) const override { return system_.apply(c, out); }
  void apply_energy(std::span<const double> c, std::span<double> out) const override {
    hierarchy_.finest().energy.apply(c, out);
  }
  IterationResult solve(std::span<const double> b, std::span<double> c, const IterationLimits& limits,
                        double scale) const override {
    return batten::solve(system_, b, c, limits, scale);
  }
  std::vector<double> right_side(std::span<const double> weights, std::span<const double> values) const override;
  std::vector<double> values(std::span<const double> c) const override;
  std::vector<double> whole(std::span<const double> c) const override;
  std::unique_ptr<PenalisedProblem> on(const Rectangle& grid) const override;

private:
  const FitData& data_;
  FitOptions options_;
  SpaceEnds ends_;
  Hierarchy hierarchy_;
  GridPoints points_;
  std::vector<double> value_, weight_;
  std::vector<std::size_t> order_;
  Multigrid system_;
};

/// A solved fit in the scale of FitData.
struct ScaledFit {
  std::vector<double> coefficients;
  double lambda = 0;
  int iterations = 0;
  double accuracy = 0;
};

/// The fit for a given λ. `start`: coefficients to begin with, or none.
ScaledFit solve_fixed(PenalisedProblem& problem, double lambda, const FitOptions& options,
                      std::vector<double> start = {});

}  // namespace batten
