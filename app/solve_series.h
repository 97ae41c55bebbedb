// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/solve_work.h>

namespace batten {

/// Finds and writes the modes that the file asks for: a file and perhaps a picture of each, and their collection.
void solve_modes(SolveWork& work);

/// Finds and writes the motion that the file asks for: a file of each state, and their collection.
void solve_motion(SolveWork& work);

}  // namespace batten
