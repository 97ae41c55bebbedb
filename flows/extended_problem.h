// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/fit_problem.h>
#include <batten/flows/flow_sides.h>

#include <Eigen/Dense>

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace batten {

/// A function g outside of the space of a problem.
struct ExtraFunction {
  std::vector<double> coefficients;  ///< among all splines, as PenalisedProblem::whole
  std::vector<double> values;        ///< B g
  std::vector<double> energy;        ///< T^T E g
  double own_energy = 0;             ///< g · E g
};
ExtraFunction extra_function(const SideFunction& function, const FitProblem& problem);

/// The penalised least-squares problem of splines that keep conditions at their sides plus a few functions that do not,
/// p = T c + Σ_k q_k g_k. The unknowns are c and then q.
///
/// The functions are made orthogonal to the space in the inner product of A once for each λ, by a solution of the
/// splines' problem for each: then q is found from right-hand sides at once, and the rest is that problem alone.
class ExtendedProblem : public PenalisedProblem {
public:
  /// Makes this problem on another grid.
  using Remake = std::function<std::unique_ptr<PenalisedProblem>(const Rectangle& grid)>;

  /// No two of the functions have energy together, g_k · E g_l = 0. The limits are those of the solutions for them.
  ExtendedProblem(std::unique_ptr<PenalisedProblem> inner, std::vector<ExtraFunction> functions,
                  const IterationLimits& limits, Remake remake);

  const Rectangle& region() const override { return inner_->region(); }
  std::size_t unknowns() const override { return inner_->unknowns() + functions_.size(); }
  const std::vector<double>& value() const override { return inner_->value(); }
  const std::vector<double>& weight() const override { return inner_->weight(); }
  const std::vector<std::size_t>& order() const override { return inner_->order(); }
  using PenalisedProblem::set;
  void set(double lambda, std::span<const double> weights, std::span<const double> beside) override;
  bool can_predict() const override { return inner_->can_predict(); }
  double apply(std::span<const double> c, std::span<double> out) const override;
  void apply_energy(std::span<const double> c, std::span<double> out) const override;
  IterationResult solve(std::span<const double> b, std::span<double> c, const IterationLimits& limits,
                        double scale) const override;
  std::vector<double> right_side(std::span<const double> weights, std::span<const double> values) const override;
  std::vector<double> values(std::span<const double> c) const override;
  std::vector<double> whole(std::span<const double> c) const override;
  std::unique_ptr<PenalisedProblem> on(const Rectangle& grid) const override { return remake_(grid); }

private:
  struct Function : ExtraFunction {
    std::vector<double> weighted;  // W B g
    std::vector<double> column;    // T^T A g
    std::vector<double> nearest;   // A^-1 of the column: g less T of it is orthogonal to the space
  };
  void set_schur();

  std::unique_ptr<PenalisedProblem> inner_;
  std::vector<Function> functions_;
  IterationLimits limits_;
  Remake remake_;
  double lambda_ = 0;
  PairWeights weights_;
  Eigen::MatrixXd products_;            // g_k · A g_l
  Eigen::LDLT<Eigen::MatrixXd> schur_;  // of the functions made orthogonal
};

}  // namespace batten
