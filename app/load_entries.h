// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/field_entry.h>
#include <batten/fem/boundary_problem.h>

namespace batten {

/// The table [load]: q, points, lines, patches. Throws InvalidInput for points of a Poisson problem, for what lies
/// outside the region, lines without length, empty patches.
Loads loads_of(const TomlValue& table, bool is_plate, const FieldReader& fields);

/// The table [supports]: points, lines. Throws InvalidInput for points of a Poisson problem without a radius and points
/// of a plate with one, and as above.
Supports supports_of(const TomlValue& table, bool is_plate, const FieldReader& fields);

}  // namespace batten
