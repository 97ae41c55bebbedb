// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/fit.h>

#include <array>
#include <cstddef>
#include <random>

namespace batten {

/// Franke's test function on the unit square [Franke 1979].
double franke(double x, double y);

/// Points that are uniformly random in the unit square, the same ones on every machine.
class RandomPoints {
public:
  std::array<double, 2> next() {
    const double x = uniform();
    return {x, uniform()};
  }

private:
  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  std::mt19937_64 random_{1};
};

/// Values of Franke's function, without noise, at the first `count` RandomPoints.
Observations random_observations(std::size_t count);

/// The unit square with this many cells.
Rectangle unit_square(int nx, int ny);

}  // namespace batten
