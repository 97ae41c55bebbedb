// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/flow_masks.h>
#include <batten/bases/staggered_field.h>

namespace batten {

struct FlowSubdivisionOptions {
  int levels = 1;
  FieldSides sides = FieldSides::Open;
};

/// The field after some steps, walls half as long with each [Warren & Weimer 2001, sec. 5.3.4].
///
/// Open sides leave those walls that the field determines. Nearest ones leave the region of the field. Zero ones leave
/// all walls that move: reach_in_cells(masks) cells of the given field more on each side.
///
/// The commuting kind keeps a field without divergence so within its region, whatever lies beyond. Throws InvalidInput
/// when the field is none (see require_field), levels are negative, the result has more than 2^30 cells, or an open
/// field determines no wall.
StaggeredField subdivided(const FlowMasks<double>& masks, const StaggeredField& field,
                          const FlowSubdivisionOptions& options = {});

/// How many fine cells an open field loses on each side in a step.
int reach_in_cells(const FlowMasks<double>& masks);

}  // namespace batten
