// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/nearest_point.h>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <vector>

namespace batten {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel>;

struct NearestPoint::Triangulation {
  Delaunay delaunay;
  Delaunay::Face_handle start;  // a face at the vertex found last
};

NearestPoint::NearestPoint(std::span<const double> x, std::span<const double> y)
    : triangulation_(std::make_unique<Triangulation>()) {
  if (x.empty() || x.size() != y.size()) {
    throw InvalidInput("NearestPoint: as many x as y are expected, at least one; found " + std::to_string(x.size()) +
                       " and " + std::to_string(y.size()));
  }
  std::vector<Kernel::Point_2> points;
  points.reserve(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) points.emplace_back(x[i], y[i]);
  triangulation_->delaunay.insert(points.begin(), points.end());
}

double NearestPoint::distance(double x, double y) {
  const auto nearest = triangulation_->delaunay.nearest_vertex({x, y}, triangulation_->start);
  triangulation_->start = nearest->face();
  return std::hypot(x - nearest->point().x(), y - nearest->point().y());
}

NearestPoint::~NearestPoint() = default;
NearestPoint::NearestPoint(NearestPoint&& other) noexcept = default;
NearestPoint& NearestPoint::operator=(NearestPoint&& other) noexcept = default;

}  // namespace batten
