// SPDX-License-Identifier: MIT
#include <batten/bases/affine_maps.h>
#include <batten/domains/errors.h>

#include <cmath>
#include <string>

namespace batten {
namespace {

/// Twice the signed area.
double doubled_area(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b, const Eigen::RowVector2d& c) {
  const Eigen::RowVector2d u = b - a, v = c - a;
  return u.x() * v.y() - u.y() * v.x();
}

void require_shapes(std::span<const Eigen::MatrixXd> maps, std::span<const Eigen::MatrixXd> polygons) {
  for (const auto& S : maps)
    for (const auto& p : polygons)
      if (S.rows() != S.cols() || S.cols() != p.rows())
        throw InvalidInput("iterated_maps: a square map of the size of the polygon is needed, found " +
                           std::to_string(S.rows()) + " x " + std::to_string(S.cols()) + " for " +
                           std::to_string(p.rows()) + " vertices");
}

Eigen::MatrixXd triangle_map(const Eigen::Matrix3d& S) { return S; }

}  // namespace

Eigen::RowVector3d barycentric_coordinates(const Eigen::RowVector2d& v, const Eigen::Matrix<double, 3, 2>& p) {
  const double whole = doubled_area(p.row(0), p.row(1), p.row(2));
  if (!(std::abs(whole) > 0)) throw InvalidInput("barycentric_coordinates: the triangle must have an area, found 0");
  return Eigen::RowVector3d(doubled_area(v, p.row(1), p.row(2)), doubled_area(p.row(0), v, p.row(2)),
                            doubled_area(p.row(0), p.row(1), v)) /
         whole;
}

Eigen::Matrix3d affine_map(const Eigen::Matrix<double, 3, 2>& p, const Eigen::Matrix<double, 3, 2>& q) {
  Eigen::Matrix3d S;
  for (int i = 0; i < 3; ++i) S.row(i) = barycentric_coordinates(q.row(i), p);
  return S;
}

std::vector<Eigen::MatrixXd> iterated_maps(std::span<const Eigen::MatrixXd> maps,
                                           std::span<const Eigen::MatrixXd> polygons, int rounds) {
  require_shapes(maps, polygons);
  const double count =
      static_cast<double>(polygons.size()) * std::pow(static_cast<double>(maps.size()), static_cast<double>(rounds));
  if (rounds < 0 || count > 0x1p24)
    throw InvalidInput("iterated_maps: rounds must not be negative nor give more than 2^24 polygons, found " +
                       std::to_string(rounds) + " rounds of " + std::to_string(maps.size()) + " maps");
  std::vector<Eigen::MatrixXd> current(polygons.begin(), polygons.end());
  for (int k = 0; k < rounds; ++k) {
    std::vector<Eigen::MatrixXd> next;
    next.reserve(maps.size() * current.size());
    for (const auto& p : current)
      for (const auto& S : maps) next.emplace_back(S * p);
    current = std::move(next);
  }
  return current;
}

std::vector<Eigen::MatrixXd> sierpinski_maps() {
  constexpr double h = 0.5;
  return {triangle_map((Eigen::Matrix3d() << 1, 0, 0, h, h, 0, h, 0, h).finished()),
          triangle_map((Eigen::Matrix3d() << h, h, 0, 0, 1, 0, 0, h, h).finished()),
          triangle_map((Eigen::Matrix3d() << h, 0, h, 0, h, h, 0, 0, 1).finished())};
}

std::vector<Eigen::MatrixXd> koch_maps() {
  constexpr double a = 1. / 3, b = 2. / 3;
  return {triangle_map((Eigen::Matrix3d() << 1, 0, 0, b, a, 0, b, 0, a).finished()),
          triangle_map((Eigen::Matrix3d() << b, 0, a, b, a, 0, a, a, a).finished()),
          triangle_map((Eigen::Matrix3d() << a, a, a, 0, a, b, a, 0, b).finished()),
          triangle_map((Eigen::Matrix3d() << a, 0, b, 0, a, b, 0, 0, 1).finished())};
}

}  // namespace batten
