// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/curve_samples.h>

#include <filesystem>
#include <span>

namespace batten {

/// Writes curves as VTK poly data (.vtp, raw appended, uncompressed): one polyline for each, numbered from 0 by the
/// cell array "curve"; the arrays, which all curves must share, as point data. Throws IoError if the file cannot be
/// written, InvalidInput if lengths or arrays do not match.
void write_curves(const std::filesystem::path& path, std::span<const CurveSamples> curves);

}  // namespace batten
