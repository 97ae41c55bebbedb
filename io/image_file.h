// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/grid_samples.h>
#include <batten/domains/record.h>

#include <filesystem>

namespace batten {

/// Writes `grid` as VTK image data (.vti, raw appended, uncompressed), with the array "value" or "speed" as active
/// scalars and "gradient" or "velocity" (if it has three components) as active vectors. `record` goes into the field
/// data, every double bit for bit: batten.kind, .degree, .cells, .region, .array.NAME, .number.NAME, .text.NAME.
/// Throws IoError if the file cannot be written, InvalidInput if an array does not fit the grid.
void write_image(const std::filesystem::path& path, const GridSamples& grid, const Record& record);

/// The record in a file of `write_image` or `write_quads`. Throws IoError if there is no such file or it cannot be
/// read, InvalidInput if it is neither of these or was not written by Batten.
Record read_record(const std::filesystem::path& path);

}  // namespace batten
