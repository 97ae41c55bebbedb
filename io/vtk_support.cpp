// SPDX-License-Identifier: MIT
#include <batten/io/vtk_support.h>

namespace batten {

bool has_vtk() { return true; }

}  // namespace batten
