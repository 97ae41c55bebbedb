// SPDX-License-Identifier: MIT
#pragma once

#include <batten/fem/constraint_account.h>

#include <optional>
#include <string>

namespace batten {

/// The keys of a report that speak of constraints, as a JSON object: `energy_gap`, `largest_violation`,
/// `least_tolerance`, `active` and `cycles`; null where there are none.
std::string constraint_json(const std::optional<ConstraintAccount>& account);

/// ", 16 active constraints, at most 0.05 % above the least": for the summary; nothing where there are none.
std::string constraint_text(const std::optional<ConstraintAccount>& account);

}  // namespace batten
