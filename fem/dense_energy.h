// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/constrained_energy.h>

#include <Eigen/Dense>

namespace batten {

/// An energy of few unknowns, ½ c·Qc - q·c, with as many rows as you like.
class DenseEnergy : public ConstrainedEnergy {
public:
  /// Q symmetric and positive definite.
  DenseEnergy(Eigen::MatrixXd q_matrix, Eigen::VectorXd q, Eigen::MatrixXd rows);

  std::size_t rows() const override { return static_cast<std::size_t>(b_.rows()); }
  std::vector<double> values() const override;
  double energy() const override;
  std::vector<double> direction(const RowWeights& weights, std::span<const double> force, double accuracy) override;
  void advance(double step) override { c_ += step * dc_; }
  double bound(std::span<double> force) override;

  const Eigen::VectorXd& coefficients() const { return c_; }

private:
  Eigen::MatrixXd q_matrix_;
  Eigen::VectorXd q_;
  Eigen::MatrixXd b_;
  Eigen::VectorXd c_, dc_;
};

/// W v
Eigen::MatrixXd weighted(const RowWeights& weights, const Eigen::Ref<const Eigen::MatrixXd>& v);

}  // namespace batten
