// SPDX-License-Identifier: MIT
#include <batten/bench/support/galerkin_multigrid.h>
#include <batten/fem/chebyshev_step.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <cmath>
#include <random>
#include <utility>

namespace batten {
namespace {

using Eigen::VectorXd;
using Matrix = GalerkinMultigrid::Matrix;

/// P^T A P; exact variational schemes are full.
Matrix galerkin(const Matrix& A, const Matrix& P) {
  if (P.nonZeros() > P.rows() * P.cols() / 2) {
    const Eigen::MatrixXd full(P);
    return Eigen::MatrixXd(full.transpose() * (A * full)).sparseView();
  }
  const Matrix AP = A * P;
  return Matrix(P.transpose()) * AP;
}

/// 1 / (ρ A_ii), ρ the largest eigenvalue of diag(A)^-1 A: by the power method, which stays below, and a tenth more.
VectorXd scaled_inverse_diagonal(const Matrix& A) {
  constexpr int products = 60;
  const VectorXd inverse = A.diagonal().cwiseInverse();
  std::mt19937 random(1);
  VectorXd v(A.rows());
  for (double& x : v) x = random() % 2 == 0 ? 1 : -1;
  double largest = 0;
  for (int k = 0; k < products; ++k) {
    const VectorXd Av = A * v;
    largest = v.dot(Av) / v.dot(v.cwiseQuotient(inverse));
    v = inverse.cwiseProduct(Av);
    v /= v.norm();
  }
  return inverse / (1.1 * largest);
}

/// Eigenvalues that are rounding count as 0.
Eigen::MatrixXd pseudo_inverse(const Matrix& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> pairs{Eigen::MatrixXd(A)};
  const double least = 1e-11 * pairs.eigenvalues().maxCoeff();
  const VectorXd inverse = pairs.eigenvalues().unaryExpr([&](double x) { return x > least ? 1 / x : 0; });
  return pairs.eigenvectors() * inverse.asDiagonal() * pairs.eigenvectors().transpose();
}

}  // namespace

GalerkinMultigrid::GalerkinMultigrid(const Matrix& A, const Eigen::MatrixXd& Z, std::vector<Matrix> transfers,
                                     int steps)
    : null_space_(Eigen::HouseholderQR<Eigen::MatrixXd>(Z).householderQ() *
                  Eigen::MatrixXd::Identity(Z.rows(), Z.cols())),
      steps_(steps) {
  levels_.push_back({A, {}, {}, {}});
  for (Matrix& P : transfers) {
    Level& fine = levels_.back();
    Matrix coarse = galerkin(fine.A, P);
    fine.restriction = P.transpose();
    fine.P = std::move(P);
    fine.inverse_diagonal = scaled_inverse_diagonal(fine.A);
    levels_.push_back({std::move(coarse), {}, {}, {}});
  }
  coarsest_inverse_ = pseudo_inverse(levels_.back().A);
}

bool GalerkinMultigrid::visits_twice(std::size_t k, Cycle kind) const {
  return kind == Cycle::W && k > 0 && k + 1 < levels_.size();
}

VectorXd GalerkinMultigrid::cycle(std::size_t k, const VectorXd& b, Cycle kind) const {
  if (k + 1 == levels_.size()) return coarsest_inverse_ * b;
  const auto& [A, P, restriction, inverse] = levels_[k];
  VectorXd r = b, z = VectorXd::Zero(b.size()), x = z;
  const auto step = [&](int i) {
    const auto [keep, gain] = chebyshev_step(i);
    z = keep * z + gain * inverse.cwiseProduct(r);
    x += z;
  };
  for (int i = 0; i < steps_; ++i) {
    step(i);
    r -= A * z;
  }
  const VectorXd coarse = restriction * r;
  VectorXd e = cycle(k + 1, coarse, kind);
  if (visits_twice(k + 1, kind)) e += cycle(k + 1, coarse - levels_[k + 1].A * e, kind);
  z = P * e;
  x += z;
  for (int i = 0; i < steps_; ++i) {
    r -= A * z;
    step(i);
  }
  return x;
}

VectorXd GalerkinMultigrid::without_null_space(const VectorXd& v) const {
  return v - null_space_ * (null_space_.transpose() * v);
}

VectorXd GalerkinMultigrid::precondition(const VectorXd& r, Cycle kind) const {
  return without_null_space(cycle(0, without_null_space(r), kind));
}

GalerkinMultigrid::Solution GalerkinMultigrid::solve(const VectorXd& b, Cycle kind, double accuracy) const {
  constexpr int most_iterations = 200;
  Solution result{VectorXd::Zero(b.size()), 0};
  VectorXd r = b, z = precondition(r, kind), p = z;
  double size = r.dot(z);
  const double enough = accuracy * accuracy * size;
  while (size > enough && result.iterations < most_iterations) {
    const VectorXd Ap = matrix() * p;
    const double length = size / p.dot(Ap);
    result.x += length * p;
    r -= length * Ap;
    z = precondition(r, kind);
    const double before = std::exchange(size, r.dot(z));
    p = z + size / before * p;
    ++result.iterations;
  }
  return result;
}

double GalerkinMultigrid::operator_complexity() const {
  double sum = 0;
  for (const Level& level : levels_) sum += static_cast<double>(level.A.nonZeros());
  return sum / static_cast<double>(matrix().nonZeros());
}

double GalerkinMultigrid::work(Cycle kind) const {
  double sum = static_cast<double>(matrix().nonZeros()), visits = 1;
  for (std::size_t k = 0; k + 1 < levels_.size(); ++k) {
    const auto entries = static_cast<double>(levels_[k].A.nonZeros());
    if (visits_twice(k, kind)) {
      sum += visits * entries;
      visits *= 2;
    }
    sum += visits * (2 * steps_ * entries + 2 * static_cast<double>(levels_[k].P.nonZeros()));
  }
  sum += visits * static_cast<double>(coarsest_inverse_.size());
  return sum / static_cast<double>(matrix().nonZeros());
}

}  // namespace batten
