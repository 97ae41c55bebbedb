// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/subdivide_arguments.h>

namespace batten {

/// Subdivides a control grid and writes the results. Throws UsageError, InvalidInput or IoError.
void subdivide_grid(const SubdivideArguments& arguments);

}  // namespace batten
