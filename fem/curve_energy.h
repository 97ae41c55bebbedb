// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/constrained_energy.h>
#include <batten/fem/paired_band.h>

#include <vector>

namespace batten {

/// ½ ∫ |p''|² dt + ½ Σ_i w_i |p(t_i) - z_i|² of the cubic splines p at given knots, whose rows are the values at the
/// knots, component by component of one knot after the other.
///
/// Second derivatives γ are unknowns beside the values f: with the forces Q γ, the jumps of p''', and R γ = Qᵀ f,
/// Newton's equations are [W + w, Q; Qᵀ, -R], and rounding does not grow by the fourth differences of f.
class CurveEnergy : public ConstrainedEnergy {
public:
  struct Strip {
    /// Of the cells. A cell of width 0 parts two knots at the same parameter: value and slope (0) are fixed there.
    std::vector<double> widths;
    int dimension = 1;  ///< 1 to 3
    bool closed = false;
    /// w_i of each knot, 0 without; infinite: p(t_i) = z_i is kept from the start on.
    std::vector<double> weights;
    std::vector<double> targets;  ///< z_i, `dimension` numbers for each knot
  };
  /// Starts with the spline that takes these values, as many as there are rows.
  CurveEnergy(Strip strip, std::vector<double> values);

  std::size_t rows() const override { return f_.size(); }
  std::vector<double> values() const override { return f_; }
  double energy() const override;
  std::vector<double> direction(const RowWeights& weights, std::span<const double> force, double accuracy) override;
  void advance(double step) override;
  double bound(std::span<double> force) override;

  /// p'' at the knots, like the values.
  const std::vector<double>& second_derivatives() const { return gamma_; }
  int factorisations() const { return factorisations_; }

private:
  using Rows = std::vector<double>;
  std::size_t knots() const { return strip_.weights.size(); }
  std::size_t next(std::size_t cell) const { return cell + 1 == knots() ? 0 : cell + 1; }
  std::size_t place(std::size_t knot) const;
  bool is_fixed(std::size_t knot) const;
  bool is_straight(std::size_t knot) const;
  Rows forces() const;
  Rows bend_residual() const;
  double bending() const;
  enum class Hold { None, Values };
  void assemble(const RowWeights& weights, Hold hold);
  void add_cell(std::size_t cell, Hold hold);
  void solve(const Rows& force, const Rows& bend);

  Strip strip_;
  std::size_t dimension_;
  Rows f_, gamma_, df_, dgamma_;
  PairedBand band_;
  RowWeights factored_;  // the weights that the band is factored with
  int factorisations_ = 0;
};

}  // namespace batten
