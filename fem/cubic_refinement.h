// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/hierarchy.h>

#include <optional>

namespace batten {

/// Values at the nodes of a level by cubic interpolation of those on the next coarser one: the start of full multigrid
/// for degree 1, in place of R. The error of the coarse solution is smooth, that of linear interpolation is not, and as
/// large as the discretisation's; a V-cycle leaves a tenth of the one and far less of the other.
///
/// None for higher degrees, whose R is accurate enough, on the coarsest level and where the coarser level has fewer
/// than four nodes in a direction.
std::optional<TensorSum> cubic_refinement(const Hierarchy& hierarchy, int level);

}  // namespace batten
