// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/pair_weights.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace batten {
namespace {

// A block's determinant, in units of w_0 w_1, is then at least 2e-13: a thousand roundings.
constexpr double largest_correlation = 1 - 1e-13;
constexpr double rounding = 1e-9;  // of a correlation that was meant to be below 1

/// w_0 w_1 - x² without cancellation [Jeannerod, Louvet & Muller 2013].
double determinant(double w_0, double w_1, double x) {
  const double square = x * x;
  return std::fma(w_0, w_1, -square) + std::fma(-x, x, square);
}

}  // namespace

PairWeights::PairWeights(std::span<const double> own, std::span<const double> between)
    : diagonal(own.begin(), own.end()), beside(between.begin(), between.end()) {
  if (beside.empty()) return;
  if (2 * beside.size() != size())
    throw InvalidInput("PairWeights: expected a number beside each pair of " + std::to_string(size()) +
                       " rows, found " + std::to_string(beside.size()));
  for (std::size_t k = 0; k < beside.size(); ++k) {
    const double w_0 = diagonal[2 * k], w_1 = diagonal[2 * k + 1];
    const double most = std::sqrt(w_0) * std::sqrt(w_1);
    if (!(std::abs(beside[k]) <= (1 + rounding) * most))
      throw InvalidInput("PairWeights: expected positive definite blocks, found " + number_text(w_0, 6) + " and " +
                         number_text(w_1, 6) + " with " + number_text(beside[k], 6) + " beside them in block " +
                         std::to_string(k + 1));
    beside[k] = std::clamp(beside[k], -largest_correlation * most, largest_correlation * most);
  }
}

void PairWeights::multiply(std::span<double> v) const {
  if (!are_paired())
    for (std::size_t i = 0; i < size(); ++i) v[i] *= diagonal[i];
  for (std::size_t k = 0; k < beside.size(); ++k) {
    double &a = v[2 * k], &b = v[2 * k + 1];
    const double first = diagonal[2 * k] * a + beside[k] * b;
    b = beside[k] * a + diagonal[2 * k + 1] * b;
    a = first;
  }
}

PairWeights PairWeights::scaled(std::span<const double> factor) const {
  PairWeights result = *this;
  for (std::size_t i = 0; i < size(); ++i) result.diagonal[i] *= factor[i] * factor[i];
  for (std::size_t k = 0; k < beside.size(); ++k) result.beside[k] *= factor[2 * k] * factor[2 * k + 1];
  return result;
}

std::vector<double> PairWeights::lumped() const {
  std::vector<double> result = diagonal;
  for (std::size_t k = 0; k < beside.size(); ++k) {
    const double correlation = std::abs(beside[k]) / (std::sqrt(diagonal[2 * k]) * std::sqrt(diagonal[2 * k + 1]));
    result[2 * k] *= 1 + correlation;
    result[2 * k + 1] *= 1 + correlation;
  }
  return result;
}

PairWeights PairWeights::inverse() const {
  PairWeights result = *this;
  if (!are_paired())
    for (double& w : result.diagonal) w = 1 / w;
  for (std::size_t k = 0; k < beside.size(); ++k) {
    const double w_0 = diagonal[2 * k], w_1 = diagonal[2 * k + 1], all = determinant(w_0, w_1, beside[k]);
    result.diagonal[2 * k] = w_1 / all;
    result.diagonal[2 * k + 1] = w_0 / all;
    result.beside[k] = -beside[k] / all;
  }
  return result;
}

void PairWeights::soften(std::span<const double> give) {
  if (!are_paired())
    for (std::size_t i = 0; i < size(); ++i) diagonal[i] = 1 / (1 / diagonal[i] + give[i]);
  // (W^-1 + C)^-1 = (W + det W adj C) / det(1 + C W), which needs no W^-1
  for (std::size_t k = 0; k < beside.size(); ++k) {
    double &w_0 = diagonal[2 * k], &w_1 = diagonal[2 * k + 1];
    const double c_0 = give[2 * k], c_1 = give[2 * k + 1], all = determinant(w_0, w_1, beside[k]);
    const double share = 1 / (1 + c_0 * w_0 + c_1 * w_1 + c_0 * c_1 * all);
    w_0 = share * (w_0 + c_1 * all);
    w_1 = share * (w_1 + c_0 * all);
    beside[k] *= share;
  }
}

void add_lower_triangle(const PairWeights& weights, Eigen::SparseMatrix<double>& matrix) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    matrix.coeffRef(i, i) += weights.diagonal[static_cast<std::size_t>(i)];
  for (std::size_t k = 0; k < weights.beside.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(2 * k);
    matrix.coeffRef(i + 1, i) += weights.beside[k];
  }
}

}  // namespace batten
