// SPDX-License-Identifier: MIT
// What stands in for nearest_point where Batten is built without CGAL.
#include <batten/domains/errors.h>
#include <batten/domains/nearest_point.h>

namespace batten {

struct NearestPoint::Triangulation {};

NearestPoint::NearestPoint(std::span<const double>, std::span<const double>) {
  throw InvalidInput("this build of Batten has no CGAL: distances to the nearest point are not available");
}

double NearestPoint::distance(double, double) { return 0; }

NearestPoint::~NearestPoint() = default;
NearestPoint::NearestPoint(NearestPoint&& other) noexcept = default;
NearestPoint& NearestPoint::operator=(NearestPoint&& other) noexcept = default;

}  // namespace batten
