// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/staggered_field.h>

#include <string>

namespace batten {

/// Where the velocities of a table of columns x, y, u, v were taken. Its points form a grid of square cells.
enum class FlowSamples {
  Vertices,  ///< both at (x, y); at a wall the mean of its two ends
  Walls      ///< u on the wall from (x, y) upward, v on that to the right; those that leave the grid are not used
};

/// The flow in a table whose rows are in any order; "-" reads standard input. Throws IoError if it cannot be read,
/// InvalidInput that names the file, and line, column or point, if it is no such table, a point is missing, given twice
/// or off the grid, cells are not square or there are fewer than 2 x 2 points.
StaggeredField read_flow(const std::string& file, FlowSamples samples);

/// The rotation u_y - v_x at the vertices of such a grid, from a table of columns x, y, rotation. Throws likewise.
ControlGrid read_rotors(const std::string& file);

}  // namespace batten
