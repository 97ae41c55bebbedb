// SPDX-License-Identifier: MIT
#pragma once

#include <batten/flows/coupled_level.h>
#include <batten/flows/coupled_smoother.h>

#include <Eigen/Dense>

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace batten {

/// One V-cycle for the coupled system of ψ and φ.
///
/// ψ and φ can stand for each other: pairs with opposite velocities at the data cost λ E alone, which no cycle for one
/// of them knows. Where the energy outweighs the data, on fine levels, such pairs are no worse than others: each of the
/// two is smoothed for itself, and only residuals see both. The levels below are smoothed together, data-aware on the
/// finest and with softened weights on coarser ones where the data are stiff (as in Multigrid), and the last one is
/// solved directly.
class CoupledCycle {
public:
  /// `unseen`: what neither data nor energy see, or hardly, on a level, columns of coefficients. The problems are kept
  /// by reference.
  CoupledCycle(const CoupledParts& parts, std::function<Eigen::MatrixXd(int level)> unseen);

  /// For the λ and weights that both problems have already.
  void set(double lambda, const PairWeights& weights);
  /// out = B r
  void apply(std::span<const double> r, std::vector<double>& out) const;
  /// The data on the finest level, with the weights set.
  const CoupledData& data() const { return data_.front(); }

private:
  using Vector = std::vector<double>;
  struct Level {
    CoupledSmoother smoother;
    CoupledSmoother::Work work;
  };
  void find_coupled(double lambda);
  bool are_stiff(const PairWeights& weights) const;
  bool can_be_data_aware() const;
  void set_data(int level, const PairWeights& weights, bool are_softened);
  void cycle(int level, std::span<const double> b, Vector& x) const;
  void cycle_apart(int level, std::span<const double> b, Vector& x) const;
  void correct_below(int level, std::span<const double> r, Vector& coarse) const;
  void refine(int level, std::span<const double> coarse, Vector& fine) const;

  CoupledParts parts_;
  std::function<Eigen::MatrixXd(int)> unseen_;
  std::vector<CoupledData> data_;      // of all levels
  int first_ = 0, last_ = 0;           // those that are coupled; the last is solved directly
  std::vector<bool> sees_cross_;       // of the levels above
  mutable std::vector<Level> levels_;  // first_ ... last_ - 1
  std::optional<CoupledLevel> direct_;
  struct Buffers {
    Vector right, x, e;
  };
  mutable std::vector<Buffers> buffers_;
};

}  // namespace batten
