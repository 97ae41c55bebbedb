// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace batten {

/// The fields of the first row of a file; none of standard input and of pipes, which cannot be read twice.
std::vector<std::string> first_row(const std::string& file);

/// The columns of a table that hold x and y where nobody has said: those named so, otherwise the first two.
/// In standard input and pipes they must be named so.
std::vector<std::string> point_columns(const std::string& file);

}  // namespace batten
