// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace batten {

/// A result as plain data: what `io` writes into a file and reads back without loss.
/// `to_record` / `from_record` of the class that produced it live beside that class (in fem and flows).
struct Record {
  std::string kind;                                   ///< what it is: "surface" for a scalar spline on a rectangle
  int degree = 0;                                     ///< degree of the B-splines in x and y
  std::array<int, 2> cells = {0, 0};                  ///< cells in x and y
  std::array<double, 4> region = {0, 0, 0, 0};        ///< xmin, xmax, ymin, ymax in the data's own units
  std::map<std::string, std::vector<double>> arrays;  ///< named coefficient arrays, x fastest
  std::map<std::string, double> numbers;              ///< named scalars: lambda, energy, ...
  std::map<std::string, std::string> texts;           ///< named texts: energy, smoothing, ...
};

}  // namespace batten
