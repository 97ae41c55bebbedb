// SPDX-License-Identifier: MIT
#include <batten/bases/bezier.h>
#include <batten/domains/errors.h>

#include <cmath>
#include <string>

namespace batten {
namespace {

void require_points(const char* function, const Eigen::MatrixXd& polygon) {
  if (polygon.rows() == 0) throw InvalidInput(std::string(function) + ": a polygon must have a point, found none");
}

}  // namespace

Eigen::RowVectorXd bernstein_basis(int degree, double x) {
  if (degree < 0)
    throw InvalidInput("bernstein_basis: the degree must not be negative, found " + std::to_string(degree));
  Eigen::RowVectorXd b = Eigen::RowVectorXd::Zero(degree + 1);
  b[0] = 1;
  for (int m = 1; m <= degree; ++m)  // b_i^m = (1 - x) b_i^(m-1) + x b_(i-1)^(m-1)
    for (int i = m; i >= 0; --i) b[i] = (1 - x) * b[i] + (i > 0 ? x * b[i - 1] : 0);
  return b;
}

Eigen::RowVectorXd bezier_point(const Eigen::MatrixXd& polygon, double x) {
  require_points("bezier_point", polygon);
  Eigen::MatrixXd p = polygon;
  for (Eigen::Index last = p.rows() - 1; last > 0; --last)
    for (Eigen::Index i = 0; i < last; ++i) p.row(i) = (1 - x) * p.row(i) + x * p.row(i + 1);
  return p.row(0);
}

CasteljauMaps casteljau_maps(int degree) {
  if (degree < 0 || degree > 53)
    throw InvalidInput("casteljau_maps: the degree must be 0 to 53, found " + std::to_string(degree));
  return casteljau_halves(Eigen::MatrixXd::Identity(degree + 1, degree + 1));
}

CasteljauMaps casteljau_halves(const Eigen::MatrixXd& polygon) {
  require_points("casteljau_halves", polygon);
  CasteljauMaps halves{polygon, polygon};
  Eigen::MatrixXd p = polygon;
  const Eigen::Index m = p.rows() - 1;
  for (Eigen::Index j = 0; j <= m; ++j) {
    halves.left.row(j) = p.row(0);
    halves.right.row(m - j) = p.row(m - j);
    for (Eigen::Index i = 0; i < m - j; ++i) p.row(i) = 0.5 * (p.row(i) + p.row(i + 1));
  }
  return halves;
}

}  // namespace batten
