// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/feasible_set.h>

#include <array>

namespace batten {

/// Blocks of rows v_i, each a point of a Euclidean space of dimension 1 to 3, with |v_i - centre_i| <= radius_i; the
/// multipliers are those of second-order cones, scaled as by [Nesterov & Todd 1997].
class Balls : public FeasibleSet {
public:
  static constexpr int most = 4;  ///< rows of a block
  struct Options {
    int dimension = 1;
    /// A block has one more row, the first, by whose value its radius grows.
    bool is_elastic = false;
  };
  /// `centre` holds `dimension` numbers for each radius.
  Balls(std::vector<double> centre, std::vector<double> radius, const Options& options);

  void start(std::span<const double> v, double room) override;
  double count() const override { return static_cast<double>(cones_.size()); }
  double room() const override { return room_after(0); }
  double violation(std::span<const double> v) const override;
  std::size_t active() const override;
  std::vector<double> force() const override;
  double gain(std::span<const double> force) const override;
  RowWeights weights() const override;
  std::vector<double> aim(std::span<const double> v, double target, bool corrects) override;
  double respond(std::span<const double> dv) override;
  double room_after(double step) const override;
  void advance(double step) override;

private:
  using Vector = std::array<double, most>;  ///< (radius; point) of a cone, 0 beyond the dimension
  /// Slack s = (radius + first row; v - centre) and multiplier y, and what belongs to a step.
  struct Cone {
    Vector slack{}, multiplier{}, slack_change{}, multiplier_change{};
    Vector miss{};    ///< of the slack
    Vector wanted{};  ///< W^-1 (λ \ target)
    Vector axis{};    ///< v of the scaling W = β (2 v vᵀ - J)
    double beta = 1;
  };
  Vector point_of(std::size_t block, std::span<const double> v) const;
  void put(std::size_t block, const Vector& value, std::span<double> rows) const;
  void scale(Cone& cone) const;
  /// W^-1 x
  static Vector unscaled(const Cone& cone, const Vector& x);
  /// W x
  static Vector scaled(const Cone& cone, const Vector& x);

  std::vector<double> centre_, radius_;
  std::size_t dimension_, rows_;  // of a block
  bool is_elastic_;
  double margin_ = 1;  // the share of the radius that is used
  std::vector<Cone> cones_;
};

}  // namespace batten
