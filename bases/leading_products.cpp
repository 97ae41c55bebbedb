// SPDX-License-Identifier: MIT
#include <batten/bases/eigensystem.h>
#include <batten/bases/leading_products.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

struct Partial {
  std::vector<int> factors;
  Eigen::MatrixXd matrix;
};

double rate_of(const Partial& product) {
  if (product.matrix.rows() == 0) return 0;
  const double radius = eigenvalues(product.matrix).cwiseAbs().maxCoeff();
  return std::pow(radius, 1. / static_cast<double>(product.factors.size()));
}

}  // namespace

std::vector<MatrixProduct> leading_products(const std::vector<Eigen::MatrixXd>& matrices, int most) {
  std::vector<Partial> level;
  for (int e = 0; e < static_cast<int>(matrices.size()); ++e)
    level.push_back({{e}, matrices[static_cast<std::size_t>(e)]});
  std::vector<MatrixProduct> found;
  while (true) {
    std::vector<MatrixProduct> rates;
    for (const Partial& product : level) rates.push_back({product.factors, rate_of(product)});
    const auto by_rate = [](const MatrixProduct& a, const MatrixProduct& b) { return a.rate < b.rate; };
    const double best = std::max_element(rates.begin(), rates.end(), by_rate)->rate;
    const bool single = level.front().factors.size() == 1;
    for (const MatrixProduct& product : rates)
      if (single || product.rate >= best * (1 - 1e-9)) found.push_back(product);
    if (level.size() * matrices.size() > static_cast<std::size_t>(most)) break;
    std::vector<Partial> next;
    for (const Partial& product : level)
      for (std::size_t e = 0; e < matrices.size(); ++e) {
        next.push_back({product.factors, matrices[e] * product.matrix});
        next.back().factors.push_back(static_cast<int>(e));
      }
    level = std::move(next);
  }
  // Longer products must be better by more than rounding to come first.
  std::stable_sort(found.begin(), found.end(), [](const MatrixProduct& a, const MatrixProduct& b) {
    return a.rate > b.rate * (1 + 1e-6) || (a.factors.size() < b.factors.size() && a.rate > b.rate * (1 - 1e-6));
  });
  return found;
}

}  // namespace batten
