// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace batten {

/// The command line of `batten scheme`.
struct SchemeArguments {
  std::string name;
  // What makes the scheme; each belongs to some names only.
  std::optional<int> order, points, arity;
  std::optional<std::string> directions, roots, weight, mask, offset;
  std::optional<double> sigma;
  // Of polyharmonic masks and of quotients.
  std::optional<std::string> method, relaxation, symmetry, shape, zeros, numerator, denominator;
  std::optional<int> size, precision;
  // What is asked of it.
  int level = 0;
  bool values = false;
  std::vector<std::string> derivatives;
  std::vector<std::string> inner_products;
  bool smoothness = false;
  int rounds = 5;
  bool compare = false;
  // How it is shown.
  bool json = false;
  std::string picture, output;
  std::string control;
  bool closed = false;
  int threads = 0;
  bool quiet = false;
};

}  // namespace batten
