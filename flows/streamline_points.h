// SPDX-License-Identifier: MIT
#pragma once

#include <batten/flows/streamlines.h>

namespace batten {

/// What the points of a streamline are evenly spaced in.
enum class StreamlineParameter { Length, Time };

/// Steps from the seed on.
struct EvenSteps {
  StreamlineParameter parameter = StreamlineParameter::Length;
  double step = 0;   ///< in the unit of length or of time, > 0
  int most = 10000;  ///< points
};

/// The line with points at all multiples of a step of length or time (0 at the seed), and at its ends. Between the
/// points that were traced it is the cubic in length with the tangents of the field, of fourth order; time is kept
/// monotone by slopes of at most three times the mean one [Fritsch & Carlson 1980], which matters near points at rest
/// alone. Where these were more than `most` points the step is that part of the line. Throws InvalidInput
/// for a step that is not positive.
Streamline with_even_points(const FlowField& field, const Streamline& line, const EvenSteps& steps);

/// A step that looks smooth: a two hundredth of the longer side, or the time that the fastest flow takes for it.
double fine_step(const FlowField& field, StreamlineParameter parameter);

}  // namespace batten
