// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <string>

namespace batten {

/// Throws UsageError unless the name of a file that the option asks for has one of these endings and, but for .csv and
/// .json, this build can write it; IoError unless it can be written. An empty name is not asked for.
void check_output_name(const std::string& option, const std::string& file, std::initializer_list<const char*> endings);

/// Throws UsageError when a file to be written is one that is read.
void check_not_input(const std::string& file, const std::string& input);

/// Whether the name ends with .csv.
bool is_table(const std::string& file);

}  // namespace batten
