// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/grid_samples.h>

#include <string>

namespace batten {

/// Throws InvalidInput, in the name of `function`, unless every array has as many values as the grid's points (or
/// cells) and its components ask for, and the grid has at least one point.
void check_arrays(const GridSamples& grid, const std::string& function);

/// The same for scattered samples; x, y and z must have equal lengths.
void check_arrays(const ScatteredSamples& samples, const std::string& function);

}  // namespace batten
