// SPDX-License-Identifier: MIT
#include <batten/fem/least_energy.h>

#include <span>

namespace batten {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

Sparse assembled(Eigen::Index rows, std::size_t columns, const std::vector<Eigen::Triplet<double>>& entries) {
  Sparse result(rows, static_cast<Eigen::Index>(columns));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace

FreeCoefficients free_coefficients(const MeasurementMatrix::Matrix& M) {
  const auto pivots = private_functions(M);
  std::vector<int> number(static_cast<std::size_t>(M.cols()), 0);
  for (int p : pivots) number[static_cast<std::size_t>(p)] = -1;
  FreeCoefficients result;
  std::vector<Eigen::Triplet<double>> J, Z;
  for (int i = 0; i < M.cols(); ++i) {
    int& n = number[static_cast<std::size_t>(i)];
    if (n < 0) continue;
    n = static_cast<int>(result.free.size());
    Z.emplace_back(i, n, 1.);
    result.free.push_back(i);
  }
  for (int j = 0; j < M.rows(); ++j) {
    const int p = pivots[static_cast<std::size_t>(j)];
    const double weight = M.coeff(j, p);
    J.emplace_back(p, j, 1 / weight);
    for (MeasurementMatrix::Matrix::InnerIterator e(M, j); e; ++e)
      if (e.col() != p) Z.emplace_back(p, number[static_cast<std::size_t>(e.col())], -e.value() / weight);
  }
  result.J = assembled(M.cols(), static_cast<std::size_t>(M.rows()), J);
  result.Z = assembled(M.cols(), result.free.size(), Z);
  return result;
}

LeastEnergy::LeastEnergy(const Sparse& E, const MeasurementMatrix::Matrix& M) : variables_(free_coefficients(M)) {
  const Sparse image = variables_.Z.transpose() * E;
  coupling_ = image * variables_.J;
  const Sparse K = image * variables_.Z;
  factor_ = std::make_shared<const SparseCholesky>(Sparse(K.triangularView<Eigen::Lower>()));
}

Eigen::VectorXd LeastEnergy::apply(const Eigen::VectorXd& m) const {
  Eigen::VectorXd f = -(coupling_ * m);
  factor_->solve(std::span(f.data(), static_cast<std::size_t>(f.size())));
  return variables_.J * m + variables_.Z * f;
}

Eigen::MatrixXd LeastEnergy::matrix() const {
  Eigen::MatrixXd result(rows(), columns());
  for (int j = 0; j < columns(); ++j) result.col(j) = apply(Eigen::VectorXd::Unit(columns(), j));
  return result;
}

}  // namespace batten
