// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/fit_problem.h>
#include <batten/fem/preconditioned_system.h>
#include <batten/flows/flow_data.h>

#include <Eigen/Dense>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace batten {

/// Quadratic φ and ψ with grad φ = rot ψ, as coefficients of a QuadraticFunction.
struct HarmonicPair {
  std::array<double, 6> phi, psi;
};
inline constexpr std::array<HarmonicPair, 4> harmonic_pairs = {{{{0, 1, 0, 0, 0, 0}, {0, 0, 1, 0, 0, 0}},
                                                                {{0, 0, 1, 0, 0, 0}, {0, -1, 0, 0, 0, 0}},
                                                                {{0, 0, 0, 1, 0, -1}, {0, 0, 0, 0, 2, 0}},
                                                                {{0, 0, 0, 0, 1, 0}, {0, 0, 0, -0.5, 0, 0.5}}}};

/// The penalised least-squares problem of v = rot ψ + grad φ: minimise Σ w |v - v_i|² + λ (E(ψ) + ratio E(φ)). Its
/// unknowns are the coefficients of ψ and then those of φ.
///
/// Each of the two is preconditioned by its own V-cycle. They do not know that ψ and φ can stand for each other: a
/// harmonic ψ and the φ with the opposite velocity cost λ E alone, and nothing at all up to degree 2. The smooth ones
/// of these pairs are found by a direct solution for both on the coarsest level, which is added. What costs nothing is
/// taken off what the preconditioner gives.
///
/// On a sphere no pair of quadratics cancels exactly, but in small regions nearly: what the data see to less than 1e-9
/// of what they see best is taken off, as is what costs nothing in a plane.
class CoupledProblem : public PenalisedProblem, private PreconditionedSystem {
public:
  /// `data`: with the rows of ψ; kept by reference.
  CoupledProblem(const FlowData& data, const Rectangle& region, const FitOptions& options, const FlowOptions& flow);

  const SplineSpace& space() const { return stream_.hierarchy().finest().space; }

  const Rectangle& region() const override { return stream_.hierarchy().region(); }
  std::size_t unknowns() const override { return 2 * half(); }
  const std::vector<double>& value() const override { return stream_.value(); }
  const std::vector<double>& weight() const override { return stream_.weight(); }
  const std::vector<std::size_t>& order() const override { return stream_.order(); }
  void set(double lambda) override;
  bool can_predict() const override { return false; }
  double apply(std::span<const double> c, std::span<double> out) const override;
  IterationResult solve(std::span<const double> b, std::span<double> c, const IterationLimits& limits,
                        double scale) const override {
    return solve_system(*this, b, c, limits, scale);
  }
  std::vector<double> right_side(std::span<const double> weights, std::span<const double> values) const override;
  std::vector<double> values(std::span<const double> c) const override;
  std::unique_ptr<PenalisedProblem> on(const Rectangle& grid) const override;

private:
  void precondition(std::span<const double> r, std::vector<double>& out) const override;
  std::size_t half() const { return stream_.system().size(); }
  void build_coarse_data();
  void build_null_space();
  void keep_unseen();
  Eigen::VectorXd restricted(std::span<const double> r) const;

  const FlowData& data_;
  FitOptions options_;
  FlowOptions flow_;
  FitData potential_rows_;
  FitProblem stream_, potential_;
  std::vector<double> factor_;  // by which each row measures the slope of φ
  Eigen::MatrixXd null_space_;  // orthonormal: constants, and pairs that cancel
  Eigen::MatrixXd coarse_data_;
  Eigen::LLT<Eigen::MatrixXd> coarse_;
  mutable std::vector<double> part_;
};

}  // namespace batten
