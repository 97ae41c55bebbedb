// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/scheme_arguments.h>
#include <batten/app/scheme_catalogue.h>

namespace batten {

/// Throws UsageError or IoError unless the outputs that the arguments ask for can be written.
void check_scheme_outputs(const AnyScheme& scheme, const SchemeArguments& arguments);

/// Writes the picture and the .vtp or .vti file that the arguments ask for: the scaling function with its derivatives,
/// or a control polygon and its limit. Throws InvalidInput for a polygon that is too short, IoError.
void write_scheme_outputs(const AnyScheme& scheme, const SchemeArguments& arguments);

}  // namespace batten
