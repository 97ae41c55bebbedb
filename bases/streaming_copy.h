// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace batten {

constexpr std::ptrdiff_t cache_line = 8;  ///< numbers in a line of the caches

/// How many numbers an address lies beyond the start of its line.
std::ptrdiff_t place_in_line(const double* address);

/// Copies n numbers, past the caches where the processor can: memory is then written without being read first, which
/// for results larger than the caches saves half of the traffic. Lines written in part are slow: copies that follow
/// each other should meet at the start of a line. in and out do not overlap.
void streaming_copy(const double* in, std::ptrdiff_t n, double* out);

/// To be called once by each thread when its copies are done and before it says so. Waits for the memory.
void end_streaming();

}  // namespace batten
