// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/grid_energy.h>

#include <cstddef>
#include <vector>

namespace batten {

/// cost θ + J(c) of a GridEnergy and one more unknown θ, by which tolerances grow: row r has the value of one of the
/// measurements plus growth_r θ. The least θ is wanted, and J keeps the rest in order.
class ElasticEnergy : public ConstrainedEnergy {
public:
  struct Row {
    std::ptrdiff_t measurement;  ///< or -1: θ alone
    double growth;
  };
  /// `energy` is kept by reference and moves.
  ElasticEnergy(GridEnergy& energy, std::vector<Row> rows, double cost, double start);

  std::size_t rows() const override { return rows_.size(); }
  std::vector<double> values() const override { return seen(energy_.values(), theta_); }
  double energy() const override { return cost_ * theta_ + energy_.energy(); }
  std::vector<double> direction(const RowWeights& weights, std::span<const double> force, double accuracy) override;
  void advance(double step) override;
  double bound(std::span<double> force) override;

  double theta() const { return theta_; }

private:
  std::vector<double> seen(std::span<const double> measurements, double theta) const;
  /// Sums of rows' forces over each measurement.
  std::vector<double> gathered(std::span<const double> force) const;
  void set(const RowWeights& weights);
  /// Gives the forces of measurements to the rows that can bear them, and returns growth · force.
  double spread(std::span<const double> own, std::span<double> force) const;

  GridEnergy& energy_;
  std::vector<Row> rows_;
  double cost_, theta_, theta_change_ = 0;
  RowWeights weights_, inner_;  // of the rows, of the measurements
  std::vector<double> pull_;    // W growth, gathered
  std::vector<double> border_;  // the measurements' response to it
  double stiffness_ = 0;        // growth · W growth
};

}  // namespace batten
