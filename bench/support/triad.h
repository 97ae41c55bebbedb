// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace batten {

/// The memory bandwidth that the triad a = b + s c reaches over arrays much larger than the last-level cache, on all
/// threads of OpenMP. Reads and writes of the arrays are counted once, 24 bytes an entry; that a processor reads a line
/// before it writes it is counted neither here nor in what is compared with it.
class Triad {
public:
  Triad();
  /// Best of a few passes, in bytes per second.
  double bytes_per_second();
  std::size_t array_bytes() const { return a_.size() * sizeof(double); }

private:
  std::vector<double> a_, b_, c_;
};

/// Bytes of the largest cache that one core sees, 32 MB where the system does not say.
std::size_t cache_bytes();

}  // namespace batten
