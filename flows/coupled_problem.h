// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/fit_problem.h>
#include <batten/fem/preconditioned_system.h>
#include <batten/flows/coupled_cycle.h>
#include <batten/flows/extended_problem.h>
#include <batten/flows/flow_data.h>
#include <batten/flows/quadratic_pairs.h>

#include <Eigen/Dense>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace batten {

/// The penalised least-squares problem of v = rot ψ + grad φ: minimise Σ w |v - v_i|² + λ (E(ψ) + ratio E(φ)). Its
/// unknowns are the coefficients of ψ and then those of φ.
///
/// Both are preconditioned by one V-cycle, CoupledCycle.
///
/// unseen_pairs() are taken off what the preconditioner gives. On a sphere none cancels exactly, but in small regions
/// nearly: of all pairs without energy, what the data see to less than 1e-9 of what they see best is taken off.
class CoupledProblem : public PenalisedProblem, private PreconditionedSystem {
public:
  /// `data`: with the rows of ψ; kept by reference.
  CoupledProblem(const FlowData& data, const Rectangle& region, const FitOptions& options, const FlowOptions& flow);

  const SplineSpace& space() const { return stream_.hierarchy().finest().space; }
  /// A function of ψ or of φ outside of their spaces.
  ExtraFunction extra_function(const SideFunction& function, bool is_potential) const;

  const Rectangle& region() const override { return stream_.hierarchy().region(); }
  std::size_t unknowns() const override { return 2 * half(); }
  const std::vector<double>& value() const override { return stream_.value(); }
  const std::vector<double>& weight() const override { return stream_.weight(); }
  const std::vector<std::size_t>& order() const override { return stream_.order(); }
  using PenalisedProblem::set;
  void set(double lambda, std::span<const double> weights, std::span<const double> beside) override;
  bool can_predict() const override { return false; }
  double apply(std::span<const double> c, std::span<double> out) const override;
  void apply_energy(std::span<const double> c, std::span<double> out) const override;
  IterationResult solve(std::span<const double> b, std::span<double> c, const IterationLimits& limits,
                        double scale) const override {
    return solve_system(*this, b, c, limits, scale);
  }
  std::vector<double> right_side(std::span<const double> weights, std::span<const double> values) const override;
  std::vector<double> values(std::span<const double> c) const override;
  std::vector<double> whole(std::span<const double> c) const override;
  std::unique_ptr<PenalisedProblem> on(const Rectangle& grid) const override;

private:
  void precondition(std::span<const double> r, std::vector<double>& out) const override;
  std::size_t half() const { return stream_.unknowns(); }
  CoupledParts parts() const { return {stream_, potential_, factor_, flow_.ratio}; }
  void find_unseen();
  Eigen::MatrixXd unseen_on(int level) const;

  const FlowData& data_;
  FitOptions options_;
  FlowOptions flow_;
  FitData potential_rows_;
  FitProblem stream_, potential_;
  std::vector<double> factor_;         // by which each row measures the slope of φ
  std::vector<QuadraticPair> unseen_;  // with orthonormal coefficients
  Eigen::MatrixXd null_space_;         // these
  double lambda_ = 0;                  // none is set
  PairWeights weights_;
  std::optional<CoupledCycle> cycle_;
};

}  // namespace batten
