// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>

class vtkDataObject;
class vtkFieldData;

namespace batten {

/// Throws InvalidInput if `name` has characters (control characters and <>&") that VTK would write into its XML as they
/// are.
void check_name(const std::string& name);

/// Adds an array of tuples of `components` numbers that refers to `values`, which must outlive `data`. Throws as
/// `check_name`.
void add_array(vtkFieldData* data, const std::string& name, std::span<const double> values, int components);

/// Writes `data` in VTK's XML format of its type, raw appended and uncompressed, so that the file appears under its
/// name only when complete. Throws IoError.
void write_vtk(const std::filesystem::path& path, vtkDataObject* data);

}  // namespace batten
