// SPDX-License-Identifier: MIT
#pragma once

namespace batten {

/// Does this build of Batten read and write VTK files and draw pictures? Where not, all that would do so throws
/// IoError.
bool has_vtk();

}  // namespace batten
