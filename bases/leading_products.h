// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

namespace batten {

/// A product of matrices, the first factor applied first.
struct MatrixProduct {
  std::vector<int> factors;
  double rate;  ///< (spectral radius)^(1 / number of factors)
};

/// The products of up to so many factors that the number of products stays below `most`, whose rate is the largest met
/// at their length, those with the largest rate first. Rates to rounding: a lower bound of the joint spectral radius
/// [Daubechies & Lagarias 1992b].
std::vector<MatrixProduct> leading_products(const std::vector<Eigen::MatrixXd>& matrices, int most = 2000);

}  // namespace batten
