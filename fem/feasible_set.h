// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/constrained_energy.h>

#include <span>
#include <vector>

namespace batten {

/// Where the rows' values v may lie, a product of simple convex sets, with the variables of a primal-dual
/// interior-point method for them: slacks, how far v is inside, and multipliers, their product the room that is left.
class FeasibleSet {
public:
  virtual ~FeasibleSet() = default;

  /// The share of each row's width that the method leaves unused at an end, so that a result is inside in spite of what
  /// its last steps leave open. Violations and gains are those of the whole set.
  static constexpr double margin = 1e-8;

  /// Begins at these values, which may lie outside, with products of about `room` each.
  virtual void start(std::span<const double> v, double room) = 0;
  /// Number of products.
  virtual double count() const = 0;
  /// Sum of the products.
  virtual double room() const = 0;
  /// Largest distance of v from the set, in units of each row's own width.
  virtual double violation(std::span<const double> v) const = 0;
  /// Constraints at their end: those with a larger share of the largest multiplier than slack, in units.
  virtual std::size_t active() const = 0;
  /// The forces of the multipliers.
  virtual std::vector<double> force() const = 0;
  /// The greatest value of -f·v over all v in the set, which is what forces f can gain there; possibly infinite.
  virtual double gain(std::span<const double> force) const = 0;

  /// W of Newton's equations at the present point.
  virtual RowWeights weights() const = 0;
  /// Newton's force f, so that forces change to f - W dv when values change by dv: towards products of `target` each,
  /// from values v. With `corrects`, what the last response leaves in second order is taken into account
  /// [Mehrotra 1992].
  virtual std::vector<double> aim(std::span<const double> v, double target, bool corrects) = 0;
  /// The change of slacks and multipliers that belongs to dv and the last aim. Returns the longest step that leaves all
  /// positive, possibly infinite.
  virtual double respond(std::span<const double> dv) = 0;
  /// The sum of products after a step.
  virtual double room_after(double step) const = 0;
  virtual void advance(double step) = 0;
};

}  // namespace batten
