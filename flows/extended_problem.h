// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/fit_problem.h>
#include <batten/flows/flow_sides.h>

#include <Eigen/Dense>

namespace batten {

/// The penalised least-squares problem of a spline that keeps conditions at its sides plus a few functions that do not,
/// p = T c + Σ_k q_k g_k. The unknowns are c and then q.
///
/// The functions are made orthogonal to the space in the inner product of A once for each λ, by a solution of the
/// spline's problem for each: then q is found from right-hand sides at once, and the rest is that problem alone.
class ExtendedProblem : public PenalisedProblem {
public:
  /// The data are kept by reference.
  ExtendedProblem(const FitData& data, const Rectangle& region, const FitOptions& options, const SpaceEnds& ends,
                  const std::vector<SideFunction>& functions);

  const Rectangle& region() const override { return inner_.region(); }
  std::size_t unknowns() const override { return inner_.unknowns() + functions_.size(); }
  const std::vector<double>& value() const override { return inner_.value(); }
  const std::vector<double>& weight() const override { return inner_.weight(); }
  const std::vector<std::size_t>& order() const override { return inner_.order(); }
  void set(double lambda) override;
  bool can_predict() const override { return inner_.can_predict(); }
  double apply(std::span<const double> c, std::span<double> out) const override;
  IterationResult solve(std::span<const double> b, std::span<double> c, const IterationLimits& limits,
                        double scale) const override;
  std::vector<double> right_side(std::span<const double> weights, std::span<const double> values) const override;
  std::vector<double> values(std::span<const double> c) const override;
  std::vector<double> whole(std::span<const double> c) const override;
  std::unique_ptr<PenalisedProblem> on(const Rectangle& grid) const override;

private:
  struct Function {
    SideFunction polynomial;
    std::vector<double> coefficients;  // g among all splines
    std::vector<double> values;        // B g
    std::vector<double> energy;        // T^T E g
    std::vector<double> column;        // T^T A g
    std::vector<double> nearest;       // A^-1 of the column: g less T of it is orthogonal to the space
  };
  void set_schur();

  const FitData& data_;
  FitOptions options_;
  SpaceEnds ends_;
  FitProblem inner_;
  std::vector<Function> functions_;
  double lambda_ = 0;
  Eigen::MatrixXd energies_;            // g_k · E g_l
  Eigen::MatrixXd products_;            // g_k · A g_l
  Eigen::LDLT<Eigen::MatrixXd> schur_;  // of the functions made orthogonal
};

}  // namespace batten
