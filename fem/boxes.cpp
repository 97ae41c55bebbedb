// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/fem/boxes.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace batten {

Boxes::Boxes(std::vector<double> lower, std::vector<double> upper, std::vector<double> unit)
    : lower_(std::move(lower)), upper_(std::move(upper)), unit_(std::move(unit)) {
  for (std::size_t i = 0; i < unit_.size(); ++i) {
    if (std::isfinite(upper_[i])) ends_.push_back({i, 1, upper_[i] - margin * unit_[i]});
    if (std::isfinite(lower_[i])) ends_.push_back({i, -1, lower_[i] + margin * unit_[i]});
  }
}

void Boxes::start(std::span<const double> v, double room) {
  constexpr double least_slack = 0.3;  // in units: what starts outside has farther to go, not less room
  for (End& e : ends_) {
    const double slack = e.sign * (e.bound - v[e.row]), unit = unit_[e.row];
    e.slack = std::max(slack, least_slack * unit);
    e.multiplier = room / e.slack;
  }
}

double Boxes::violation(std::span<const double> v) const {
  double worst = 0;
  for (std::size_t i = 0; i < unit_.size(); ++i)
    worst = std::max({worst, (v[i] - upper_[i]) / unit_[i], (lower_[i] - v[i]) / unit_[i]});
  return worst;
}

std::size_t Boxes::active() const {
  double largest = 0;
  for (const End& e : ends_) largest = std::max(largest, e.multiplier * unit_[e.row]);
  return static_cast<std::size_t>(std::count_if(ends_.begin(), ends_.end(), [&](const End& e) {
    return e.multiplier * unit_[e.row] / largest > e.slack / unit_[e.row];
  }));
}

std::vector<double> Boxes::force() const {
  std::vector<double> force(unit_.size());
  for (const End& e : ends_) force[e.row] -= e.sign * e.multiplier;
  return force;
}

// Infinite where a force pushes towards an end that is not there.
double Boxes::gain(std::span<const double> force) const {
  double sum = 0;
  for (std::size_t i = 0; i < unit_.size(); ++i)
    if (force[i] != 0) sum -= force[i] * (force[i] > 0 ? lower_[i] : upper_[i]);
  return sum;
}

RowWeights Boxes::weights() const {
  RowWeights weights{1, std::vector<double>(unit_.size()), {}};
  for (const End& e : ends_) weights.diagonal[e.row] += e.multiplier / e.slack;
  return weights;
}

std::vector<double> Boxes::aim(std::span<const double> v, double target, bool corrects) {
  std::vector<double> force(unit_.size());
  for (End& e : ends_) {
    e.miss = e.sign * (e.bound - v[e.row]) - e.slack;
    e.wanted = target - (corrects ? e.slack_change * e.multiplier_change : 0);
    force[e.row] -= e.sign * (e.wanted - e.multiplier * e.miss) / e.slack;
  }
  return force;
}

double Boxes::respond(std::span<const double> dv) {
  double step = std::numeric_limits<double>::infinity();
  for (End& e : ends_) {
    e.slack_change = e.miss - e.sign * dv[e.row];
    e.multiplier_change = (e.wanted - e.multiplier * e.slack_change) / e.slack - e.multiplier;
    if (e.slack_change < 0) step = std::min(step, -e.slack / e.slack_change);
    if (e.multiplier_change < 0) step = std::min(step, -e.multiplier / e.multiplier_change);
  }
  return step;
}

double Boxes::room_after(double step) const {
  const int n = static_cast<int>(ends_.size());
  return sum_blocks(RowBlocks(n, 1), [&](int begin, int end) {
    double sum = 0;
    for (int k = begin; k < end; ++k) {
      const End& e = ends_[static_cast<std::size_t>(k)];
      sum += (e.slack + step * e.slack_change) * (e.multiplier + step * e.multiplier_change);
    }
    return sum;
  });
}

void Boxes::advance(double step) {
  for (End& e : ends_) {
    e.slack += step * e.slack_change;
    e.multiplier += step * e.multiplier_change;
  }
}

}  // namespace batten
