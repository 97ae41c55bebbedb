// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <utility>

namespace batten {

/// Measures the phases of the work.
class Stopwatch {
public:
  /// Seconds since it was made or last asked.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace batten
