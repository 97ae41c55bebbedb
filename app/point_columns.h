// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace batten {

/// The columns of a table that hold x and y where nobody has said: those named so, otherwise the first two.
/// Standard input and pipes cannot be read twice: there they must be named so.
std::vector<std::string> point_columns(const std::string& file);

}  // namespace batten
