// SPDX-License-Identifier: MIT
#pragma once

#include <batten/io/chart.h>

#include <string>
#include <vector>

namespace batten {

/// Charts under and beside each other. All charts have the same size; a short row is filled up with white.
void write_chart_sheet(const std::string& path, const std::vector<std::vector<Chart>>& rows);

}  // namespace batten
