// SPDX-License-Identifier: MIT
#include <batten/bases/eigensystem.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/fem/block_vectors.h>
#include <batten/fem/lowest_eigenpairs.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace batten {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::span<double> column(MatrixXd& a, Index k) { return {a.data() + k * a.rows(), static_cast<std::size_t>(a.rows())}; }

class Lobpcg {
public:
  Lobpcg(const EigenProblem& problem, MatrixXd start, const EigenOptions& options)
      : problem_(problem),
        options_(options),
        block_(start.cols()),
        errors_(VectorXd::Constant(block_, std::numeric_limits<double>::infinity())) {
    for (auto* a : {&s_, &ks_, &ms_}) a->resize(start.rows(), 3 * block_);
    s_.leftCols(block_) = start;
  }

  Eigenpairs run();

private:
  void apply_operators(Index first, Index count);
  void choose(Index columns, const std::vector<Index>& moving);
  std::vector<Index> residuals();
  void estimate(const VectorXd& residual_products, const std::vector<Index>& moving);
  double worst() const { return errors_.head(options_.wanted).maxCoeff(); }

  const EigenProblem& problem_;
  const EigenOptions& options_;
  Index block_;           // columns of X
  MatrixXd s_, ks_, ms_;  // [X P W] and K, M times it
  Index directions_ = 0;  // columns of P
  VectorXd values_, errors_;
  int preconditionings_ = 0;
};

void Lobpcg::apply_operators(Index first, Index count) {
  for (Index k = first; k < first + count; ++k) {
    problem_.stiffness(column(s_, k), column(ks_, k));
    problem_.mass(column(s_, k), column(ms_, k));
  }
}

/// The Rayleigh-Ritz step on the first columns of [X P W]. P becomes what P and W contributed to the moving vectors,
/// orthogonal to the new X.
void Lobpcg::choose(Index columns, const std::vector<Index>& moving) {
  const MatrixXd raw_gram = tall_products(s_.leftCols(columns), ms_.leftCols(columns));
  const MatrixXd raw_energy = tall_products(s_.leftCols(columns), ks_.leftCols(columns));
  const MatrixXd gram = (raw_gram + raw_gram.transpose()) / 2, energy = (raw_energy + raw_energy.transpose()) / 2;
  const MatrixXd t = orthonormalisation(gram);
  if (t.cols() < block_)
    throw SolverError("lowest_eigenpairs: expected " + std::to_string(block_) + " independent vectors, found " +
                      std::to_string(t.cols()));
  const SymmetricEigensystem ritz = symmetric_eigensystem(t.transpose() * energy * t);
  values_ = ritz.values.head(block_);
  directions_ = columns > block_ ? static_cast<Index>(moving.size()) : 0;
  MatrixXd c(columns, block_ + directions_);
  c.leftCols(block_) = t * ritz.vectors.leftCols(block_);
  for (Index k = 0; k < directions_; ++k) {
    auto p = c.col(block_ + k);
    p = c.col(moving[static_cast<std::size_t>(k)]);
    p.head(block_).setZero();
    p -= c.leftCols(block_) * (c.leftCols(block_).transpose() * (gram * p));
    const double size = p.dot(gram * p);
    if (size > 0) p /= std::sqrt(size);
  }
  for (auto* a : {&s_, &ks_, &ms_}) recombine(*a, c);
}

/// Writes W = B (K X - M X Θ) for the vectors that have not converged, orthogonal to X and of unit size, and returns
/// which they are; none once the wanted ones have.
std::vector<Index> Lobpcg::residuals() {
  std::vector<Index> moving;
  for (Index k = 0; k < block_; ++k)
    if (errors_[k] > options_.accuracy) moving.push_back(k);
  const Index first = block_ + directions_, count = static_cast<Index>(moving.size());
  VectorXd products(count), r(s_.rows());
  for (Index k = 0; k < count; ++k) {
    const Index i = moving[static_cast<std::size_t>(k)];
    r = ks_.col(i) - values_[i] * ms_.col(i);
    problem_.precondition({r.data(), static_cast<std::size_t>(r.size())}, column(s_, first + k));
    products[k] = r.dot(s_.col(first + k));
  }
  preconditionings_ += static_cast<int>(count);
  estimate(products, moving);
  if (worst() <= options_.accuracy) return {};
  auto w = s_.middleCols(first, count);
  subtract_product(w, s_.leftCols(block_), tall_products(ms_.leftCols(block_), w));
  for (Index k = 0; k < count; ++k) {
    const double size = w.col(k).norm();
    if (size > 0) w.col(k) /= size;
  }
  apply_operators(first, count);
  return moving;
}

void Lobpcg::estimate(const VectorXd& residual_products, const std::vector<Index>& moving) {
  constexpr double least_gap = 0.01;
  for (std::size_t k = 0; k < moving.size(); ++k) {
    const Index i = moving[k];
    const double gap = std::max(least_gap, 1 - values_[i] / values_[block_ - 1]);
    errors_[i] = std::abs(residual_products[static_cast<Index>(k)]) / gap / (values_[i] - options_.shift);
  }
}

Eigenpairs Lobpcg::run() {
  apply_operators(0, block_);
  choose(block_, {});
  int iterations = 0;
  for (;; ++iterations) {
    const auto moving = residuals();
    if (options_.progress) options_.progress(worst());
    if (moving.empty()) break;
    if (iterations >= options_.most_iterations || !std::isfinite(worst()))
      throw SolverError("lowest_eigenpairs: expected a relative error of at most " + number_text(options_.accuracy, 3) +
                        " after " + std::to_string(iterations) + " iterations, found " + number_text(worst(), 3));
    choose(block_ + directions_ + static_cast<Index>(moving.size()), moving);
  }
  return {values_, s_.leftCols(block_), errors_, iterations, preconditionings_};
}

}  // namespace

Eigenpairs lowest_eigenpairs(const EigenProblem& problem, MatrixXd start, const EigenOptions& options) {
  return Lobpcg(problem, std::move(start), options).run();
}

}  // namespace batten
