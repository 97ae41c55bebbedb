// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

namespace batten {

/// The distance to the nearest of a set of points of the plane, found in their Delaunay triangulation.
class NearestPoint {
public:
  /// The points (x[i], y[i]), finite; coincident and collinear ones are welcome.
  /// Throws InvalidInput if there are none, x and y differ in length, or Batten was built without CGAL.
  NearestPoint(std::span<const double> x, std::span<const double> y);
  ~NearestPoint();
  NearestPoint(NearestPoint&& other) noexcept;
  NearestPoint& operator=(NearestPoint&& other) noexcept;

  /// Distance from (x, y), finite. Starts where the last query ended: fast for queries that are near each other, and
  /// not for several threads at once.
  double distance(double x, double y);

private:
  struct Triangulation;
  std::unique_ptr<Triangulation> triangulation_;
};

}  // namespace batten
