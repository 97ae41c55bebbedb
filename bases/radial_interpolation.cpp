// SPDX-License-Identifier: MIT
#include <batten/bases/bell_basis.h>
#include <batten/bases/radial_interpolation.h>
#include <batten/domains/errors.h>

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

namespace batten {
namespace {

constexpr double largest_miss = 1e-8;

void require_data(const Eigen::MatrixX2d& points, const Eigen::VectorXd& values) {
  const std::string function = "ThinPlateInterpolant: ";
  if (points.rows() != values.size())
    throw InvalidInput(function + "there must be a value for each point, found " + std::to_string(points.rows()) +
                       " points and " + std::to_string(values.size()) + " values");
  if (points.rows() < 3)
    throw InvalidInput(function + "at least 3 points are needed, found " + std::to_string(points.rows()));
  if (!points.allFinite() || !values.allFinite())
    throw InvalidInput(function + "points and values must be finite, found one that is not");
}

void require_different(const Eigen::MatrixX2d& points) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(points.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    return std::pair(points(a, 0), points(a, 1)) < std::pair(points(b, 0), points(b, 1));
  });
  for (std::size_t k = 1; k < order.size(); ++k)
    if (points.row(order[k]) == points.row(order[k - 1]))
      throw InvalidInput("ThinPlateInterpolant: all points must be different, found that points " +
                         std::to_string(order[k - 1]) + " and " + std::to_string(order[k]) + " are the same");
}

/// Rows 1, x, y.
Eigen::MatrixX3d linear_functions(const Eigen::MatrixX2d& points) {
  Eigen::MatrixX3d P(points.rows(), 3);
  P << Eigen::VectorXd::Ones(points.rows()), points;
  return P;
}

/// [C P; P^T 0], C_ij = c_2(x_i - x_j).
Eigen::MatrixXd interpolation_matrix(const Eigen::MatrixX2d& points) {
  const Eigen::Index n = points.rows();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + 3, n + 3);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i)
      A(i, j) = polyharmonic_green(2, points(i, 0) - points(j, 0), points(i, 1) - points(j, 1));
  A.topRightCorner(n, 3) = linear_functions(points);
  A.bottomLeftCorner(3, n) = linear_functions(points).transpose();
  return A;
}

}  // namespace

ThinPlateInterpolant::ThinPlateInterpolant(const Eigen::Ref<const Eigen::MatrixX2d>& points,
                                           const Eigen::Ref<const Eigen::VectorXd>& values) {
  require_data(points, values);
  require_different(points);
  // A change of scale changes c_2 by a multiple of r², of which the side conditions leave a linear polynomial.
  centre_ = points.colwise().mean();
  scale_ = (points.rowwise() - centre_).rowwise().norm().maxCoeff();
  points_ = (points.rowwise() - centre_) / scale_;
  if (Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(linear_functions(points_)).rank() < 3)
    throw InvalidInput("ThinPlateInterpolant: points must not all be on a line, found that they are");
  const Eigen::Index n = points.rows();
  const Eigen::MatrixXd A = interpolation_matrix(points_);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 3);
  right.head(n) = values;
  const Eigen::VectorXd solution = A.partialPivLu().solve(right);
  const double miss = (A * solution - right).cwiseAbs().maxCoeff();
  if (!(miss <= largest_miss * values.cwiseAbs().maxCoeff()))
    throw SolverError("ThinPlateInterpolant: values must be met to 1e-8 of the largest, found an error of " +
                      std::to_string(miss) + ": some points are too close to each other");
  weights_ = solution.head(n);
  linear_ = solution.tail<3>();
}

Eigen::Vector2d ThinPlateInterpolant::normalised(double x, double y) const {
  return Eigen::Vector2d(x - centre_[0], y - centre_[1]) / scale_;
}

double ThinPlateInterpolant::value(double x, double y) const {
  const Eigen::Vector2d t = normalised(x, y);
  double sum = linear_[0] + linear_.tail<2>().dot(t);
  for (Eigen::Index i = 0; i < weights_.size(); ++i)
    sum += weights_[i] * polyharmonic_green(2, t[0] - points_(i, 0), t[1] - points_(i, 1));
  return sum;
}

Eigen::Vector2d ThinPlateInterpolant::gradient(double x, double y) const {
  const Eigen::Vector2d t = normalised(x, y);
  Eigen::Vector2d sum = linear_.tail<2>();
  for (Eigen::Index i = 0; i < weights_.size(); ++i) {
    const Eigen::Vector2d d = t - points_.row(i).transpose();
    const double rho = d.squaredNorm();
    if (rho > 0) sum += weights_[i] * (std::log(rho) + 1) / (8 * std::numbers::pi) * d;
  }
  return sum / scale_;
}

}  // namespace batten
