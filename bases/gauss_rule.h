// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace batten {

/// Gauss-Legendre quadrature on [0, 1]: Σ weight[i] f(place[i]) is the integral of polynomials of degree 2n - 1.
struct GaussRule {
  std::vector<double> place;   ///< ascending
  std::vector<double> weight;  ///< sum 1
};

/// The rule of n points. Throws InvalidInput unless 1 <= n <= 20.
GaussRule gauss_rule(int n);

}  // namespace batten
