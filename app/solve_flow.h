// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/solve_work.h>

namespace batten {

/// Finds and writes the slow flow that the file asks for: a result as `batten flow` writes it, and perhaps its picture
/// with streamlines.
void solve_flow(SolveWork& work);

}  // namespace batten
