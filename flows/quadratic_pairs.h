// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/null_space.h>
#include <batten/flows/flow_sides.h>

#include <vector>

namespace batten {

/// ψ and φ of degree 2, from the middle of a region over its longer side.
struct QuadraticPair {
  QuadraticFunction psi, phi;
};

/// A basis of the pairs that keep side_conditions() and cancel in a plane, rot ψ + grad φ = 0, constants among them:
/// what neither data nor energy see. grad φ is harmonic then, one of those of x, y, x² - y², x y and their sums.
std::vector<QuadraticPair> unseen_pairs(const Rectangle& region, const FlowSides& sides);

/// The same without cancelling: all pairs without energy.
std::vector<QuadraticPair> pairs_without_energy(const Rectangle& region, const FlowSides& sides);

/// Those that cancel, where only their velocities keep what the sides ask for: ψ may differ between walls, ψ and φ
/// along periodic directions. No constants.
std::vector<QuadraticPair> exchangeable_pairs(const Rectangle& region, const FlowSides& sides);

}  // namespace batten
