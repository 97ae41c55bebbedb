// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/grid_samples.h>
#include <batten/domains/record.h>

#include <string>

namespace batten {

/// Writes a grid as the ending of the name says: a table (.csv, without arrays of cells and record), quads (.vtu), else
/// an image (.vti). Throws IoError.
void write_samples(const std::string& file, const GridSamples& samples, const Record& record);

}  // namespace batten
