// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/flow_basis.h>

namespace batten {

/// Σ spacing rotation(i,j) g((x, y) - (i, j)) over the vertices of a coarse grid of one component, its spacing the
/// unit: the flow without divergence that has this rotation u_y - v_x at vertices and none (perfect flow) or a harmonic
/// one (slow flow) between. Components u, v on the vertices of level `levels` of the same rectangle; NaN where they are
/// infinite, at the vertices where perfect flow has rotation.
///
/// Throws InvalidInput unless there is one component of 2 x 2 finite numbers or more and one spacing, levels are not
/// negative and the result has at most 2^28 vertices.
ControlGrid flow_of_rotors(const FlowBasis& basis, const ControlGrid& rotation, int levels);

/// flow_at() on the vertices of a level of the field's rectangle: the limit of the exact scheme for a field that is at
/// rest outside. By n_u = g(x, y + 1/2) - g(x, y - 1/2) it is the flow of its rotors, where rotation of the size of
/// rounding counts as none, so that perfect flow is finite there.
ControlGrid flow_limit(const FlowBasis& basis, const StaggeredField& field, int levels);

}  // namespace batten
