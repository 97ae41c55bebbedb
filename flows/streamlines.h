// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/curve_samples.h>
#include <batten/flows/flow_field.h>

#include <vector>

namespace batten {

/// Lengths are in those of the longer side of the region, on a sphere of FlowGeometry::longer_side.
struct StreamlineOptions {
  double tolerance = 1e-10;  ///< of the error of a step: in length, and in the time that the fastest flow takes for it
  double longest = 10;       ///< upstream and downstream each
  double slowest = 1e-6;     ///< the part of the largest speed at the corners of cells below which a point is at rest
};

/// Why a streamline ends.
enum class StreamlineEnd {
  Side,    ///< on a side of the region, a coordinate exactly that of the side
  AtRest,  ///< at a point of stagnation
  Length,  ///< longer than asked for
  Closed,  ///< where it started
};

/// Points in the direction of the flow. A closed one ends with the point it starts with, after the time of one turn.
struct Streamline {
  std::vector<double> x, y;
  std::vector<double> time, length;  ///< 0 at the seed, negative upstream
  StreamlineEnd upstream = StreamlineEnd::Length, downstream = StreamlineEnd::Length;

  bool closed() const { return downstream == StreamlineEnd::Closed; }
};

/// Follows a field: dx/ds = v / |v|, dt/ds = 1 / |v|, s the length of the line, by the Runge-Kutta pair of order 5(4)
/// with steps of at most a cell [Dormand & Prince 1980]. The field is the spline, not samples of it. On a sphere s is
/// the length on it; x and y stay degrees.
class StreamlineTracer {
public:
  /// `field` is kept by reference. Throws InvalidInput for options that are not positive.
  explicit StreamlineTracer(const FlowField& field, const StreamlineOptions& options = {});

  /// The line through (x, y), both ways. One point alone if the field is at rest there. Throws InvalidInput for a point
  /// outside the region.
  Streamline trace(double x, double y) const;

  /// `count` lines: the first through the middle of the region, each other one through the point of a grid of 64 x 64
  /// that is farthest from the lines before [Mebarki, Alliez & Devillers 2005]. Points at rest are passed over, so that
  /// there may be fewer.
  std::vector<Streamline> evenly_spaced(int count) const;

private:
  struct State;
  struct Step;
  class Walk;

  State slope(const State& at, double direction) const;
  Step step(const State& from, double length, double direction) const;

  const FlowField& field_;
  StreamlineOptions options_;
  double side_, speed_, longest_step_;
};

/// The largest speed at the corners of the cells.
double largest_speed(const FlowField& field);

/// The line with the arrays "speed", "time", "length" and "vorticity"; name and z are empty and 0.
CurveSamples samples_of(const FlowField& field, const Streamline& line);

}  // namespace batten
