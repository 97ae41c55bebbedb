// SPDX-License-Identifier: MIT
#include <batten/bases/flow_limit.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace batten {
namespace {

void require_rotors(const ControlGrid& rotation, int levels) {
  const std::string name = "flow_of_rotors: ";
  if (rotation.components.size() != 1)
    throw InvalidInput(name + "one component is needed, found " + std::to_string(rotation.components.size()));
  const Eigen::MatrixXd& r = rotation.components[0];
  if (r.rows() < 2 || r.cols() < 2)
    throw InvalidInput(name + "2 x 2 vertices or more are needed, found " + std::to_string(r.rows()) + " x " +
                       std::to_string(r.cols()));
  if (!r.allFinite()) throw InvalidInput(name + "rotation must be finite");
  const auto [hx, hy] = rotation.spacing;
  if (!(hx > 0) || hx != hy)
    throw InvalidInput(name + "cells must be square, found the spacing " + number_text(hx, 6) + " in x and " +
                       number_text(hy, 6) + " in y");
  if (levels < 0) throw InvalidInput(name + "levels must not be negative, found " + std::to_string(levels));
  if (std::ldexp(static_cast<double>(r.rows() - 1), levels) * std::ldexp(static_cast<double>(r.cols() - 1), levels) >
      1 << 28)
    throw InvalidInput(name + "the result would have more than 2^28 vertices, on level " + std::to_string(levels));
}

/// g at (i, j) / 2^levels, i from -nx to nx in rows, j from 0 to ny in columns.
struct GeneratorTable {
  Eigen::MatrixXd u, v;
};

GeneratorTable tabulated(const FlowBasis& basis, Eigen::Index nx, Eigen::Index ny, int levels) {
  GeneratorTable g{Eigen::MatrixXd(2 * nx + 1, ny + 1), Eigen::MatrixXd(2 * nx + 1, ny + 1)};
#pragma omp parallel for schedule(static)
  for (Eigen::Index j = 0; j <= ny; ++j)
    for (Eigen::Index i = 0; i <= nx; ++i) {
      const auto [u, v] =
          basis.generator(std::ldexp(static_cast<double>(i), -levels), std::ldexp(static_cast<double>(j), -levels));
      g.u(nx + i, j) = g.u(nx - i, j) = u;
      g.v(nx - i, j) = -v;
      g.v(nx + i, j) = v;
    }
  if (basis.flow() == Flow::Perfect) g.u(nx, 0) = g.v(nx, 0) = std::numeric_limits<double>::quiet_NaN();
  return g;
}

struct Rotor {
  Eigen::Index i, j;  ///< on the fine grid
  double strength;
};

std::vector<Rotor> rotors_of(const ControlGrid& rotation, int levels) {
  const Eigen::MatrixXd& r = rotation.components[0];
  std::vector<Rotor> rotors;
  for (Eigen::Index j = 0; j < r.cols(); ++j)
    for (Eigen::Index i = 0; i < r.rows(); ++i)
      if (r(i, j) != 0) rotors.push_back({i << levels, j << levels, rotation.spacing[0] * r(i, j)});
  return rotors;
}

}  // namespace

ControlGrid flow_of_rotors(const FlowBasis& basis, const ControlGrid& rotation, int levels) {
  require_rotors(rotation, levels);
  const Eigen::Index nx = (rotation.components[0].rows() - 1) << levels;
  const Eigen::Index ny = (rotation.components[0].cols() - 1) << levels;
  const GeneratorTable g = tabulated(basis, nx, ny, levels);
  const std::vector<Rotor> rotors = rotors_of(rotation, levels);
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(nx + 1, ny + 1), v = u;
#pragma omp parallel for schedule(static)
  for (Eigen::Index j = 0; j <= ny; ++j)
    for (const auto& [at_i, at_j, strength] : rotors) {
      const Eigen::Index row = std::abs(j - at_j);
      u.col(j) += (j < at_j ? -strength : strength) * g.u.col(row).segment(nx - at_i, nx + 1);
      v.col(j) += strength * g.v.col(row).segment(nx - at_i, nx + 1);
    }
  const double spacing = std::ldexp(rotation.spacing[0], -levels);
  return {.components = {std::move(u), std::move(v)}, .start = rotation.start, .spacing = {spacing, spacing}};
}

ControlGrid flow_limit(const FlowBasis& basis, const StaggeredField& field, int levels) {
  ControlGrid rotors = rotation(padded(field, 1, FieldSides::Zero));
  // Four velocities, each given to a half of its last digit, and three sums of up to four of them.
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  const double least =
      rounding * std::max(field.u.cwiseAbs().maxCoeff(), field.v.cwiseAbs().maxCoeff()) / field.spacing;
  for (double& r : rotors.components[0].reshaped())
    if (std::abs(r) <= least) r = 0;
  return flow_of_rotors(basis, rotors, levels);
}

}  // namespace batten
