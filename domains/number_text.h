// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace batten {

/// A number for a reader: `digits` significant digits, trailing zeros left out.
std::string number_text(double value, int digits = 4);

/// An amount of memory: "850 MB", "3.1 GB".
std::string bytes_text(double bytes);

}  // namespace batten
