// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace batten {

/// The bytes of a PNG file of width x height pixels, three bytes each, row by row from the top. Throws IoError if they
/// cannot be encoded.
std::string encode_png(int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace batten
