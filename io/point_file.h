// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/grid_samples.h>

#include <filesystem>

namespace batten {

/// Writes scattered points as VTK poly data (.vtp, raw appended, uncompressed): one vertex per point, the arrays as
/// point data, the first with one component as active scalars and the first with three as active vectors. Throws
/// IoError if the file cannot be written, InvalidInput if lengths do not match.
void write_points(const std::filesystem::path& path, const ScatteredSamples& samples);

}  // namespace batten
