// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/subdivide_arguments.h>

#include <string>

namespace batten {

/// Variational schemes of bounded grids: bounded-harmonic, bounded-thin-plate, bounded-tension.
bool is_bounded_scheme(const std::string& name);

/// Subdivides a control grid by the scheme that the energy has on its rectangle, sides free, and writes the results
/// [Warren & Weimer 2001, sec. 6.4]. Throws UsageError, InvalidInput or IoError.
void subdivide_bounded(const SubdivideArguments& arguments);

}  // namespace batten
