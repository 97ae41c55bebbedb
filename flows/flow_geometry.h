// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/rectangle.h>

namespace batten {

/// Mean radius of the Earth in km, (2 a + b) / 3 of the ellipsoid WGS 84.
inline constexpr double earth_radius = 6371;

/// What the coordinates of a flow are: lengths in a plane, or degrees on a sphere, x the longitude and y the latitude.
class FlowGeometry {
public:
  static FlowGeometry plane() { return {}; }
  /// Lengths in the unit of the radius. Throws InvalidInput for a radius that is not positive.
  static FlowGeometry sphere(double radius = earth_radius);

  bool is_sphere() const { return radius_ > 0; }
  /// 0 of a plane.
  double radius() const { return radius_; }

  /// Length of one unit of x at y: R cos y π / 180, in a plane 1.
  double length_x(double y) const;
  /// Length of one unit of y: R π / 180, in a plane 1.
  double length_y() const;
  /// tan y / R, by which parallels bend: the divergence is u_x + v_y - v tan y / R, the vorticity v_x - u_y + u tan y /
  /// R. In a plane 0.
  double bend(double y) const;
  /// How many units of x one unit of y counts as: 1 / cos of the mid latitude, in a plane 1.
  double aspect(const Rectangle& region) const;
  /// The longer side of the region, that along x measured at the middle.
  double longer_side(const Rectangle& region) const;

  /// Throws InvalidInput unless a region on a sphere lies between the poles, which have no longitude, and is at most
  /// 360 degrees wide.
  void expect_inside(const Rectangle& region) const;

  bool operator==(const FlowGeometry&) const = default;

private:
  double radius_ = 0;
};

}  // namespace batten
