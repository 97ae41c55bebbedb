// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/grid_samples.h>
#include <batten/domains/record.h>

#include <filesystem>

namespace batten {

/// Writes `grid` as `write_image` does, but as a VTK unstructured grid (.vtu): its points, in their order, and a quad
/// for each cell, corners counterclockwise, x fastest. Throws as `write_image`, and InvalidInput if there is no cell.
void write_quads(const std::filesystem::path& path, const GridSamples& grid, const Record& record);

}  // namespace batten
