// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/hierarchy.h>

#include <array>
#include <vector>

namespace batten {

/// What a flow does at a side of its rectangle.
enum class FlowSide {
  Free,     ///< nothing is known
  Wall,     ///< no flow through it
  NoSlip,   ///< no flow at all
  Periodic  ///< it goes on at the opposite side
};

struct FlowSides {
  FlowSide left = FlowSide::Free, right = FlowSide::Free, bottom = FlowSide::Free, top = FlowSide::Free;

  std::array<FlowSide, 4> all() const { return {left, right, bottom, top}; }
  bool are_free() const { return *this == FlowSides{}; }
  bool have(FlowSide side) const;
  /// True if there is a wall on every side.
  bool are_closed() const;
  bool operator==(const FlowSides&) const = default;
};

/// True where nothing flows through.
inline bool is_wall(FlowSide side) { return side == FlowSide::Wall || side == FlowSide::NoSlip; }

/// A spline that a flow is made of: ψ or φ, alone or both.
struct FlowPart {
  bool is_potential = false;
  bool has_other = false;  ///< the flow is rot ψ + grad φ
};

/// The conditions of ψ, which is 0 on all walls that are connected with each other, or of φ, which beside ψ is 0 on
/// walls without slip that are connected. Throws InvalidInput if only one of two opposite sides is periodic, if walls
/// without slip are asked of φ alone, or of both where no side is free (see fit_flow).
SpaceEnds side_conditions(const FlowSides& sides, const FlowPart& part);

/// A cubic polynomial of one coordinate, Σ_k c_k τ^k, τ from 0 to 1 across the region.
struct SideFunction {
  enum class Along { X, Y };
  Along along;
  std::array<double, 4> c;

  int degree() const;
  /// Its coefficients in a space of all splines of degree 3 or more.
  std::vector<double> coefficients(const SplineSpace& space) const;
};

/// What a flow between such sides has besides the splines that keep side_conditions(), at most two functions: a mean
/// flow along each direction in which it is periodic and not stopped by walls, and the flux between two walls that are
/// not connected, whose ψ differ by it. Where both ψ and φ make the flow, none that the spaces of both have already: a
/// mean flow that is grad φ in the space of φ, or that of ψ for φ. Then φ may differ between two walls without slip.
std::vector<SideFunction> side_functions(const FlowSides& sides, const FlowPart& part);

}  // namespace batten
