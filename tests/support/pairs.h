// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/pair_weights.h>

#include "observations.h"
#include <Eigen/Dense>

#include <cmath>

namespace batten::test {

/// Symmetric weights of pairs, turned by random angles, with eigenvalues between unit / 10^decades and unit 10^decades.
inline PairWeights random_pairs(std::size_t pairs, double unit, double decades, unsigned seed) {
  Random random(seed);
  PairWeights result;
  for (std::size_t k = 0; k < pairs; ++k) {
    const double angle = 6.283185307179586 * random(), c = std::cos(angle), s = std::sin(angle);
    const double a = unit * std::pow(10, decades * (2 * random() - 1)),
                 b = unit * std::pow(10, decades * (2 * random() - 1));
    result.diagonal.insert(result.diagonal.end(), {a * c * c + b * s * s, a * s * s + b * c * c});
    result.beside.push_back((a - b) * c * s);
  }
  return result;
}

/// W as a matrix.
inline Eigen::MatrixXd dense(const PairWeights& weights) {
  const auto n = static_cast<Eigen::Index>(weights.size());
  Eigen::MatrixXd result = Eigen::Map<const Eigen::VectorXd>(weights.diagonal.data(), n).asDiagonal();
  for (std::size_t k = 0; k < weights.beside.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(2 * k);
    result(i, i + 1) = result(i + 1, i) = weights.beside[k];
  }
  return result;
}

inline double least_eigenvalue(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

}  // namespace batten::test
