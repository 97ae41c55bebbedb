// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace batten {

/// The fewest insertions, deletions and replacements of single letters that turn one word into the other.
int edit_distance(std::string_view a, std::string_view b);

/// The name of least edit distance to `word`, capitals counting as small letters; the first of several.
std::string nearest_name(std::string_view word, std::span<const char* const> names);

/// The names with commas between them.
std::string name_list(std::span<const char* const> names);

}  // namespace batten
