// SPDX-License-Identifier: MIT
#include <batten/fem/null_space.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

namespace batten {
namespace {

/// Coefficients of (x - x0)² / length², means of products of two different knots, less those of ((x - x0) / length)²
/// at the Greville abscissae.
std::vector<double> square_excess(const SplineBasis& basis, double length) {
  const auto& interval = basis.interval();
  const int d = basis.degree();
  const double unit = interval.finest_cell_length() / length;
  std::vector<double> result;
  for (int i = 0; i < basis.size(); ++i) {
    double sum = 0, squares = 0;
    const double origin = interval.breakpoints()[static_cast<std::size_t>(std::clamp(i - d / 2, 0, interval.cells()))];
    for (int k = 1; k <= d; ++k) {
      const double t =
          interval.breakpoints()[static_cast<std::size_t>(std::clamp(i + k - d, 0, interval.cells()))] - origin;
      sum += t;
      squares += t * t;
    }
    result.push_back(unit * unit * ((sum * sum - squares) / (d * (d - 1.)) - sum * sum / (static_cast<double>(d) * d)));
  }
  return result;
}

}  // namespace

double QuadraticFunction::operator()(double x, double y) const {
  const double s = (x - x0) / length, t = (y - y0) / length;
  return c[0] + c[1] * s + c[2] * t + c[3] * s * s + c[4] * s * t + c[5] * t * t;
}

void QuadraticFunction::add_to(const SplineSpace& space, std::span<double> coefficients) const {
  const auto gx = space.x.greville(), gy = space.y.greville();
  const auto ex = square_excess(space.x, length), ey = square_excess(space.y, length);
  std::size_t index = 0;
  for (std::size_t j = 0; j < gy.size(); ++j)
    for (std::size_t i = 0; i < gx.size(); ++i)
      coefficients[index++] += (*this)(gx[i], gy[j]) + c[3] * ex[i] + c[5] * ey[j];
}

void LinearFunction::add_to(const SplineSpace& space, std::span<double> coefficients) const {
  const auto gx = space.x.greville(), gy = space.y.greville();
  std::size_t index = 0;
  for (double gy_j : gy)
    for (double gx_i : gx) coefficients[index++] += (*this)(gx_i, gy_j);
}

double flatness(std::span<const double> x, std::span<const double> y) {
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  double x0 = 0, y0 = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    x0 += x[i] / static_cast<double>(x.size());
    y0 += y[i] / static_cast<double>(x.size());
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Eigen::Vector2d v(x[i] - x0, y[i] - y0);
    moments += v * v.transpose();
  }
  // Distances from the principal axis themselves: the smaller eigenvalue would only tell their square root from
  // rounding.
  const Eigen::Vector2d across = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(moments).eigenvectors().col(0);
  double square = 0;
  for (std::size_t i = 0; i < x.size(); ++i) square += std::pow(across[0] * (x[i] - x0) + across[1] * (y[i] - y0), 2);
  const double extent = moments.trace() - square;
  return extent > 0 ? std::sqrt(square / extent) : 0;
}

LinearFunction fit_null_space(int degree, std::span<const double> x, std::span<const double> y,
                              std::span<const double> values, std::span<const double> weights) {
  LinearFunction f;
  double total = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    total += weights[i];
    f.x0 += weights[i] * x[i];
    f.y0 += weights[i] * y[i];
    f.a += weights[i] * values[i];
  }
  f.x0 /= total;
  f.y0 /= total;
  f.a /= total;
  // Twice: the second pass fits what rounding left of the first, so that linear data leave nothing but their own
  // rounding.
  for (int pass = 0; pass < 2; ++pass) {
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Eigen::Vector3d v(1, x[i] - f.x0, y[i] - f.y0);
      moments += weights[i] / total * v * v.transpose();
      right += weights[i] / total * (values[i] - f(x[i], y[i])) * v;
    }
    if (degree == 0) {
      f.a += right[0];
      continue;
    }
    const Eigen::Vector3d step = moments.completeOrthogonalDecomposition().solve(right);
    f.a += step[0];
    f.b += step[1];
    f.c += step[2];
  }
  return f;
}

}  // namespace batten
