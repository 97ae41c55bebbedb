// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/fit.h>

#include <cmath>
#include <concepts>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

namespace batten::test {

/// Franke's function [Franke 1982].
inline double franke(double x, double y) {
  const auto square = [](double v) { return v * v; };
  return 0.75 * std::exp(-(square(9 * x - 2) + square(9 * y - 2)) / 4) +
         0.75 * std::exp(-square(9 * x + 1) / 49 - (9 * y + 1) / 10) +
         0.5 * std::exp(-(square(9 * x - 7) + square(9 * y - 3)) / 4) -
         0.2 * std::exp(-square(9 * x - 4) - square(9 * y - 7));
}

/// A uniform random number in [0, 1), the same on every machine.
class Random {
public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  /// Standard normal, by Box and Muller.
  double normal() { return std::sqrt(-2 * std::log(1 - (*this)())) * std::cos(6.283185307179586 * (*this)()); }

private:
  std::mt19937_64 engine_;
};

/// f at n random points of the unit square.
template <std::invocable<double, double> F>
Observations random_observations(std::size_t n, unsigned seed, F&& f) {
  Random random(seed);
  Observations o;
  for (std::size_t i = 0; i < n; ++i) {
    o.x.push_back(random());
    o.y.push_back(random());
    o.value.push_back(f(o.x.back(), o.y.back()));
  }
  return o;
}

/// Columns a, b and c (from 0) of one of the example files, which have a header line and commas.
inline Observations example_data(const std::string& name, std::size_t a, std::size_t b, std::size_t c) {
  std::ifstream file(std::string(BATTEN_DATA) + "/" + name);
  if (!file) throw std::runtime_error("cannot read " + name);
  Observations o;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::vector<double> row;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) row.push_back(std::stod(cell));
    o.x.push_back(row.at(a));
    o.y.push_back(row.at(b));
    o.value.push_back(row.at(c));
  }
  return o;
}

inline Rectangle unit_square(int nx, int ny) { return {Interval(0, 1, nx), Interval(0, 1, ny)}; }

}  // namespace batten::test
