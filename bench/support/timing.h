// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <concepts>
#include <limits>

namespace batten {

/// Seconds that `work` takes.
template <std::invocable Work>
double seconds_of(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The least of several measurements: what the machine can do when it is left alone.
template <std::invocable Work>
double least_seconds(int repeats, Work&& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < repeats; ++k) least = std::min(least, seconds_of(work));
  return least;
}

}  // namespace batten
