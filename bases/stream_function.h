// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/staggered_field.h>

namespace batten {

/// ψ at the (nx+1) x (ny+1) vertices of a field, 0 at the first, whose flow
///   u(i,j) = (ψ(i,j+1) - ψ(i,j)) / spacing,   v(i,j) = -(ψ(i+1,j) - ψ(i,j)) / spacing
/// comes nearest to the field: the sum over all cells of the squared errors at their four walls is least. One
/// component.
///
/// Where no cell has divergence there is no error but rounding, and what flows through a wall is the difference of ψ at
/// its ends. Else the difference of the two is the gradient of a potential in the cells. At inner vertices ψ obeys
/// Poisson's equation, the sum of its four neighbours less 4 ψ being spacing² rotation(field).
ControlGrid stream_function(const StaggeredField& field);

}  // namespace batten
