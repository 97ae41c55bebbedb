// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>
#include <batten/flows/flow_geometry.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace batten {
namespace {

constexpr double radians = std::numbers::pi / 180;
constexpr double pole = 90, full_circle = 360;  // degrees

double middle(const Interval& interval) { return interval.lower() + interval.length() / 2; }

}  // namespace

FlowGeometry FlowGeometry::sphere(double radius) {
  if (!(radius > 0 && std::isfinite(radius)))
    throw InvalidInput("FlowGeometry: expected a positive radius, found " + number_text(radius, 6));
  FlowGeometry result;
  result.radius_ = radius;
  return result;
}

double FlowGeometry::length_x(double y) const { return is_sphere() ? radius_ * radians * std::cos(y * radians) : 1; }

double FlowGeometry::length_y() const { return is_sphere() ? radius_ * radians : 1; }

double FlowGeometry::bend(double y) const { return is_sphere() ? std::tan(y * radians) / radius_ : 0; }

double FlowGeometry::aspect(const Rectangle& region) const { return length_y() / length_x(middle(region.y)); }

double FlowGeometry::longer_side(const Rectangle& region) const {
  return std::max(region.x.length() * length_x(middle(region.y)), region.y.length() * length_y());
}

void FlowGeometry::expect_inside(const Rectangle& region) const {
  if (!is_sphere()) return;
  const auto& [x, y] = region;
  if (!(y.lower() > -pole && y.upper() < pole))
    throw InvalidInput("expected latitudes (y) of the region between -90 and 90 degrees, poles excluded, found " +
                       number_text(y.lower(), 6) + " to " + number_text(y.upper(), 6));
  if (x.length() > full_circle * (1 + 1e-12))
    throw InvalidInput("expected longitudes (x) of the region over at most 360 degrees, found " +
                       number_text(x.lower(), 6) + " to " + number_text(x.upper(), 6));
}

}  // namespace batten
