// SPDX-License-Identifier: MIT
#include <batten/fem/interior_point.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

constexpr double predictor_accuracy = 0.1, corrector_accuracy = 0.01;
constexpr double share_of_longest_step = 0.95;

/// Steps that have become short while the values are outside.
class Stall {
public:
  bool is_found(double step, double violation) {
    constexpr double short_step = 0.02;
    constexpr int most = 4;
    count_ = step < short_step && violation > 0 ? count_ + 1 : 0;
    return count_ == most;
  }

private:
  int count_ = 0;
};

/// One step from values v. Returns its length.
double advance(ConstrainedEnergy& energy, FeasibleSet& set, std::span<const double> v, double room) {
  const RowWeights weights = set.weights();
  const double predicted =
      std::min(1., set.respond(energy.direction(weights, set.aim(v, 0, false), predictor_accuracy)));
  const double centring = std::pow(set.room_after(predicted) / room, 3), target = centring * room / set.count();
  const double longest = set.respond(energy.direction(weights, set.aim(v, target, true), corrector_accuracy));
  const double step = std::min(1., share_of_longest_step * longest);
  energy.advance(step);
  set.advance(step);
  return step;
}

}  // namespace

InteriorPointResult minimise(ConstrainedEnergy& energy, FeasibleSet& set, const InteriorPointOptions& options) {
  InteriorPointResult result;
  Stall stall;
  for (double widest = 0;; ++result.steps) {
    const auto v = energy.values();
    const double room = set.room();
    result.violation = std::max(0., set.violation(v));
    result.energy = energy.energy();
    const double scale = std::max(result.energy, options.least_energy);
    if (result.violation == 0 && room <= options.gap * scale) {
      result.force = set.force();
      const double bound = energy.bound(result.force) - set.gain(result.force);
      result.gap = (result.energy - bound) / scale;
      result.converged = result.gap <= options.gap;
      if (result.converged) return result;
    }
    if (result.steps == options.most_steps) return result;
    widest = std::max(widest, room / scale);
    if (options.progress)
      options.progress(std::clamp(std::log(widest * scale / room) / std::log(widest / options.gap), 0., 1.));
    if (stall.is_found(advance(energy, set, v, room), result.violation)) return result;
  }
}

}  // namespace batten
