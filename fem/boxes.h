// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/feasible_set.h>

namespace batten {

/// lower_i <= v_i <= upper_i, either of which may be infinite.
class Boxes : public FeasibleSet {
public:
  /// lower + 2 margin unit < upper. `unit`: positive, the width in which violations of row i are measured.
  Boxes(std::vector<double> lower, std::vector<double> upper, std::vector<double> unit);

  void start(std::span<const double> v, double room) override;
  double count() const override { return static_cast<double>(ends_.size()); }
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
  /// A finite end of a box: slack sign (bound - v) and multiplier, and how they change.
  struct End {
    std::size_t row;
    double sign;   ///< 1 above, -1 below
    double bound;  ///< less the margin
    double slack = 1, multiplier = 0;
    double slack_change = 0, multiplier_change = 0;
    double miss = 0;    ///< of the slack: sign (bound - v) - slack
    double wanted = 0;  ///< (slack + change)(multiplier + change) to first order
  };

  std::vector<double> lower_, upper_, unit_;
  std::vector<End> ends_;
};

}  // namespace batten
