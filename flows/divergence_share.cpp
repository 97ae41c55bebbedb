// SPDX-License-Identifier: MIT
#include <batten/flows/divergence_share.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace batten {

double divergence_share(const FlowField& field, std::uint64_t seed) {
  constexpr int points = 2000;
  constexpr double part_of_cell = 1e-3;
  const auto &ix = field.region().x, &iy = field.region().y;
  const FlowGeometry& geometry = field.geometry();
  const double dx = part_of_cell * ix.finest_cell_length(), dy = part_of_cell * iy.finest_cell_length();
  std::mt19937_64 random(seed);
  const auto within = [&](const Interval& interval, double margin) {
    const double share = static_cast<double>(random() >> 11) * 0x1p-53;
    return interval.lower() + margin + share * (interval.length() - 2 * margin);
  };
  double divergence = 0, gradient = 0;
  for (int k = 0; k < points; ++k) {
    const double x = within(ix, dx), y = within(iy, dy);
    const auto left = field.velocity(x - dx, y), right = field.velocity(x + dx, y);
    const auto low = field.velocity(x, y - dy), high = field.velocity(x, y + dy);
    const double width = 2 * dx * geometry.length_x(y), height = 2 * dy * geometry.length_y();
    const double u_x = (right.u - left.u) / width, v_x = (right.v - left.v) / width;
    const double u_y = (high.u - low.u) / height, v_y = (high.v - low.v) / height;
    divergence = std::max(divergence, std::abs(u_x + v_y - geometry.bend(y) * (high.v + low.v) / 2));
    gradient = std::max(gradient, std::sqrt(u_x * u_x + v_x * v_x + u_y * u_y + v_y * v_y));
  }
  return gradient > 0 ? divergence / gradient : 0;
}

}  // namespace batten
