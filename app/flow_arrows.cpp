// SPDX-License-Identifier: MIT
#include <batten/app/flow_arrows.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

/// A place and a velocity, both as they are drawn: in units of x and of y.
struct Arrow {
  double x, y, u, v;
};

constexpr int along_longer_side = 26;  // so many arrows at most

double speed_of(const Arrow& arrow, double aspect) { return std::hypot(arrow.u, aspect * arrow.v); }

/// What the longest arrows stand for: the largest speed, but at most three times the root mean square, so that one
/// whirl does not leave the others without arrows.
double speed_of_longest(const std::vector<Arrow>& arrows, double aspect) {
  constexpr double most = 3;
  double fastest = 0, squares = 0, count = 0;
  for (const Arrow& arrow : arrows) {
    const double speed = speed_of(arrow, aspect);
    if (!std::isfinite(speed)) continue;
    fastest = std::max(fastest, speed);
    squares += speed * speed;
    ++count;
  }
  return count > 0 ? std::min(fastest, most * std::sqrt(squares / count)) : 0;
}

/// The arrows at places so far apart in units of x; one of y is `aspect` times as long.
std::vector<CurveSamples> curves_of(const std::vector<Arrow>& arrows, double apart, double aspect) {
  constexpr double longest = 0.95, shortest = 0.04;  // of their distance, and of the longest
  const double most = speed_of_longest(arrows, aspect);
  std::vector<CurveSamples> curves;
  for (const Arrow& a : arrows) {
    const double speed = speed_of(a, aspect);
    if (!std::isfinite(speed) || !(speed > shortest * most)) continue;
    const double half = longest * apart / std::max(most, speed) / 2;
    curves.push_back({.x = {a.x - half * a.u, a.x + half * a.u}, .y = {a.y - half * a.v, a.y + half * a.v}});
  }
  return curves;
}

}  // namespace

std::vector<CurveSamples> arrows_of(const FlowField& field) {
  const auto &ix = field.region().x, &iy = field.region().y;
  // Lengths in units of x at the middle, as the picture has them.
  const FlowGeometry& geometry = field.geometry();
  const double aspect = geometry.aspect(field.region()), unit = geometry.length_y() / aspect;
  const double apart = std::max(ix.length(), aspect * iy.length()) / along_longer_side;
  const int nx = std::max(1, static_cast<int>(ix.length() / apart));
  const int ny = std::max(1, static_cast<int>(aspect * iy.length() / apart));
  std::vector<Arrow> arrows;
  for (int k = 0; k < nx * ny; ++k) {
    const double x = ix.lower() + ix.length() * (k % nx + 0.5) / nx, y = iy.lower() + iy.length() * (k / nx + 0.5) / ny;
    const auto [u, v] = field.velocity(x, y);
    arrows.push_back({x, y, u * unit / geometry.length_x(y), v / aspect});
  }
  return curves_of(arrows, apart, aspect);
}

std::vector<CurveSamples> arrows_of(const GridSamples& samples) {
  const auto [nx, ny] = samples.points;
  const int step = (std::max(nx, ny) - 3) / along_longer_side + 1;
  const auto first = [step](int points) {
    return 1 + (points - 3) % step / 2;
  };  // none on the sides, where half is cut
  const auto velocity = std::find_if(samples.arrays.begin(), samples.arrays.end(),
                                     [](const PointArray& array) { return array.name == "velocity"; });
  std::vector<Arrow> arrows;
  for (int j = first(ny); j + 1 < ny; j += step)
    for (int i = first(nx); i + 1 < nx; i += step) {
      const auto at = static_cast<std::size_t>(velocity->components) * static_cast<std::size_t>(i + j * nx);
      arrows.push_back({samples.origin[0] + i * samples.spacing[0], samples.origin[1] + j * samples.spacing[1],
                        velocity->values[at], velocity->values[at + 1]});
    }
  return curves_of(arrows, step * samples.spacing[0], 1);
}

}  // namespace batten
