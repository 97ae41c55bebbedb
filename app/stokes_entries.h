// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/field_entry.h>
#include <batten/app/toml_entries.h>
#include <batten/flows/stokes.h>

namespace batten {

/// The slow flow that a file with problem = "stokes" describes: its tables [material], [load] and [sides], on the cells
/// of `fields`. Throws InvalidInput for a side that says neither how the fluid moves nor one of the known words, for
/// tables and loads of other problems, with the reason, and for sides through which more flows in than out.
StokesProblem stokes_of(const TomlEntries& file, int degree, const FieldReader& fields);

}  // namespace batten
