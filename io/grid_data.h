// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/grid_samples.h>
#include <batten/domains/record.h>

#include <string>

class vtkDataSet;

namespace batten {

/// What the files of a grid hold besides its points: the arrays of points and cells, which must outlive `set`, and the
/// record. Throws InvalidInput for names that VTK's XML cannot hold.
void add_grid_data(vtkDataSet* set, const GridSamples& grid, const Record& record);

/// The record of `add_grid_data`. Throws InvalidInput, in the name of the file, if it is missing or damaged.
Record record_in(vtkDataSet* set, const std::string& file);

}  // namespace batten
