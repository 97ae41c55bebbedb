// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace batten {

/// Writes `count` random points of Franke's function as columns x, y, z, separated by tabs, each number the shortest
/// text that reads back as the same double. The header is "# x y z": a comment for programs that know none. Keeps no
/// more than a line in memory.
void write_point_table(const std::string& file, std::size_t count);

}  // namespace batten
