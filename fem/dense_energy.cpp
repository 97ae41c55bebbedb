// SPDX-License-Identifier: MIT
#include <batten/fem/dense_energy.h>

#include <utility>

namespace batten {
namespace {

Eigen::Map<const Eigen::VectorXd> view(std::span<const double> v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

std::vector<double> copy(const Eigen::VectorXd& v) { return {v.begin(), v.end()}; }

}  // namespace

Eigen::MatrixXd weighted(const RowWeights& weights, const Eigen::Ref<const Eigen::MatrixXd>& v) {
  const Eigen::Index together = weights.together;
  Eigen::MatrixXd result = view(weights.diagonal).asDiagonal() * v;
  std::size_t pair = 0;
  for (Eigen::Index first = 0; first < v.rows(); first += together)
    for (Eigen::Index a = first; a < first + together; ++a)
      for (Eigen::Index b = a + 1; b < first + together; ++b, ++pair) {
        result.row(a) += weights.beside[pair] * v.row(b);
        result.row(b) += weights.beside[pair] * v.row(a);
      }
  return result;
}

DenseEnergy::DenseEnergy(Eigen::MatrixXd q_matrix, Eigen::VectorXd q, Eigen::MatrixXd rows)
    : q_matrix_(std::move(q_matrix)),
      q_(std::move(q)),
      b_(std::move(rows)),
      c_(Eigen::VectorXd::Zero(q_.size())),
      dc_(c_) {}

std::vector<double> DenseEnergy::values() const { return copy(b_.lazyProduct(c_)); }

double DenseEnergy::energy() const { return c_.dot(q_matrix_ * c_) / 2 - q_.dot(c_); }

std::vector<double> DenseEnergy::direction(const RowWeights& weights, std::span<const double> force, double) {
  const Eigen::MatrixXd a = q_matrix_ + b_.transpose().lazyProduct(weighted(weights, b_));  // one thread: the same bits
  dc_ = a.ldlt().solve(q_ - q_matrix_ * c_ + b_.transpose().lazyProduct(view(force)));
  return copy(b_.lazyProduct(dc_));
}

double DenseEnergy::bound(std::span<double> force) {
  const Eigen::VectorXd pull = q_ + b_.transpose().lazyProduct(view(force));
  return -pull.dot(q_matrix_.ldlt().solve(pull)) / 2;
}

}  // namespace batten
