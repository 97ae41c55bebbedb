// SPDX-License-Identifier: MIT
#pragma once

#include <batten/bases/subdivide.h>

#include <Eigen/Core>

#include <array>

namespace batten {

/// A plane flow on the walls of nx x ny square cells: what crosses them [Warren & Weimer 2001, sec. 5.3.2].
///
///      v        u(i,j) on vertical walls, at start + (i, j + 1/2) spacing, (nx+1) x ny of them,
///    u   u      v(i,j) on horizontal walls, at start + (i + 1/2, j) spacing, nx x (ny+1).
///      v
struct StaggeredField {
  Eigen::MatrixXd u, v;
  std::array<double, 2> start{0, 0};
  double spacing = 1;

  int cells_x() const { return static_cast<int>(v.rows()); }
  int cells_y() const { return static_cast<int>(u.cols()); }
};

/// Throws InvalidInput that names the function unless the sizes fit nx, ny >= 1 cells, all numbers are finite and the
/// spacing is positive.
void require_field(const char* function, const StaggeredField& field);

/// The flow of a grid of vertices with the components u and v, at walls the mean of their two ends. Throws InvalidInput
/// unless there are two components of the same size, 2 x 2 or more, and one spacing, equal to 1e-6 in x and y.
StaggeredField from_vertices(const ControlGrid& vertices);

// Results are grids of one component unless said otherwise, with the places of their values. Inner vertices are those
// between four walls, (nx-1) x (ny-1): none in a single row of cells, which throws InvalidInput.

/// Components u, v at inner vertices, each the mean of the two walls that end there.
ControlGrid vertex_averages(const StaggeredField& field);
/// u_x + v_y at the centres of the cells: what flows out of a cell, over its area.
ControlGrid divergence(const StaggeredField& field);
/// u_y - v_x at inner vertices; the opposite of the vorticity.
ControlGrid rotation(const StaggeredField& field);

/// What lies beyond the sides of a field.
enum class FieldSides {
  Open,    ///< unknown velocities: only walls whose rules lie within the field exist
  Zero,    ///< a flow at rest, so that sums of basis functions come out whole
  Nearest  ///< on each wall the velocity of the nearest one known
};

/// With so many cells more on each side; for Open sides as it is.
StaggeredField padded(const StaggeredField& field, int cells, FieldSides sides);
/// With so many cells less on each side. Throws InvalidInput when none is left.
StaggeredField cropped(const StaggeredField& field, int cells);

}  // namespace batten
