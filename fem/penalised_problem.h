// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/rectangle.h>
#include <batten/fem/conjugate_gradients.h>

#include <memory>
#include <span>
#include <vector>

namespace batten {

/// A penalised least-squares problem on one grid, minimise Σ_i w_i (value_i - (B c)_i)² + λ c · E c, as
/// cross-validation and the method of multipliers see it.
class PenalisedProblem {
public:
  virtual ~PenalisedProblem() = default;

  virtual const Rectangle& region() const = 0;
  virtual std::size_t unknowns() const = 0;
  virtual const std::vector<double>& value() const = 0;       ///< of each measurement, in the order of the grid
  virtual const std::vector<double>& weight() const = 0;      ///< in the order of the grid
  virtual const std::vector<std::size_t>& order() const = 0;  ///< index of each measurement as it was given
  std::size_t size() const { return value().size(); }

  /// A = λ E + B^T W B from now on, with weights of one's own, all positive, or those of the data. `beside`: none, or
  /// x_k of each pair of measurements 2k and 2k + 1 at one point, whose weights are the positive definite block
  /// [[w_2k, x_k], [x_k, w_2k+1]], as of PairWeights.
  virtual void set(double lambda, std::span<const double> weights, std::span<const double> beside) = 0;
  void set(double lambda, std::span<const double> weights) { set(lambda, weights, {}); }
  void set(double lambda) { set(lambda, weight()); }
  /// As Multigrid::can_predict.
  virtual bool can_predict() const = 0;
  /// out = A c. Returns c · A c.
  virtual double apply(std::span<const double> c, std::span<double> out) const = 0;
  /// out = E c
  virtual void apply_energy(std::span<const double> c, std::span<double> out) const = 0;
  /// Solves A c = b from the start c; `scale` as of batten::solve.
  virtual IterationResult solve(std::span<const double> b, std::span<double> c, const IterationLimits& limits,
                                double scale) const = 0;
  /// B^T (weights values)
  virtual std::vector<double> right_side(std::span<const double> weights, std::span<const double> values) const = 0;
  /// B c
  virtual std::vector<double> values(std::span<const double> c) const = 0;
  /// value - B c
  std::vector<double> residuals(std::span<const double> c) const {
    auto r = values(c);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = value()[i] - r[i];
    return r;
  }
  /// The coefficients of the spline that the unknowns stand for, among all splines.
  virtual std::vector<double> whole(std::span<const double> c) const { return {c.begin(), c.end()}; }
  /// The same measurements on another grid of the region.
  virtual std::unique_ptr<PenalisedProblem> on(const Rectangle& grid) const = 0;
};

}  // namespace batten
