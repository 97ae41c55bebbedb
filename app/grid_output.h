// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/subdivide_arguments.h>
#include <batten/domains/grid_samples.h>

#include <string>

namespace batten {

/// Writes what was subdivided as -o asks. `kind` is that of the record, `what` its scheme. Throws IoError.
void write_subdivided(const SubdivideArguments& arguments, const std::string& kind, const std::string& what,
                      const GridSamples& samples);

/// Writes a subdivided grid with the array "value" as -o and --picture ask. `what` is the picture's title and the
/// record's scheme. Throws IoError.
void write_grid_outputs(const SubdivideArguments& arguments, const std::string& what, const GridSamples& samples);

}  // namespace batten
