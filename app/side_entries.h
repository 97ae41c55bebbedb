// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/field_entry.h>
#include <batten/fem/boundary_problem.h>

namespace batten {

/// The table [sides]: of each of left, right, bottom and top what docs/solve.md lists. Throws InvalidInput for a side
/// that is missing, unknown words, what the kind of problem does not allow, and a periodic side whose opposite is not.
Sides sides_of(const TomlValue& table, bool is_plate, const FieldReader& fields);

}  // namespace batten
