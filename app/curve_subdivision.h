// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/subdivide_arguments.h>

namespace batten {

/// Subdivides a curve and writes the results. Throws UsageError, InvalidInput or IoError.
void subdivide_curve(const SubdivideArguments& arguments);

/// Whether there are options that only curves have, other than --parameter and --show.
bool asks_for_curve(const SubdivideArguments& arguments);

/// Whether the input is a curve: a table with a header, or the scheme one of curves alone.
bool is_curve(const SubdivideArguments& arguments);

}  // namespace batten
