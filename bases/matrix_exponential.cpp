// SPDX-License-Identifier: MIT
#include <batten/bases/matrix_exponential.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

using Series = std::vector<Eigen::MatrixXcd>;

double norm(const Eigen::MatrixXcd& A) { return A.size() == 0 ? 0 : A.cwiseAbs().rowwise().sum().maxCoeff(); }

Series squared(const Series& P) {
  Series product(P.size(), Eigen::MatrixXcd::Zero(P[0].rows(), P[0].cols()));
  for (std::size_t k = 0; k < P.size(); ++k)
    for (std::size_t l = 0; k + l < P.size(); ++l) product[k + l] += P[k] * P[l];
  return product;
}

/// P (A + B σ)
Series times_linear(const Series& P, const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B) {
  Series product;
  for (std::size_t k = 0; k < P.size(); ++k) {
    product.emplace_back(P[k] * A);
    if (k > 0) product[k] += P[k - 1] * B;
  }
  return product;
}

}  // namespace

std::vector<Eigen::MatrixXcd> shift_exponential(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B,
                                                std::size_t terms) {
  const double size = norm(A) + norm(B);
  const int squarings = size > 0.5 ? static_cast<int>(std::ceil(std::log2(size))) + 1 : 0;
  const double scale = std::ldexp(1., -squarings);
  constexpr int last_power = 16;  // 0.5^17 / 17! < 2.2e-20: the first power left out
  Series power(terms, Eigen::MatrixXcd::Zero(A.rows(), A.cols()));
  power[0].setIdentity();
  Series sum = power;
  for (int n = 1; n <= last_power; ++n) {
    power = times_linear(power, scale / n * A, scale / n * B);
    for (std::size_t k = 0; k < terms; ++k) sum[k] += power[k];
  }
  for (int i = 0; i < squarings; ++i) sum = squared(sum);
  return sum;
}

}  // namespace batten
