// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace batten {

/// Seconds that a part of the work took.
struct PhaseTime {
  std::string phase;
  double seconds;
};

/// Calls work and notes how long it took.
template <typename Work>
auto timed(std::vector<PhaseTime>& seconds, const std::string& phase, Work&& work) {
  struct Stop {
    std::vector<PhaseTime>& list;
    const std::string& name;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    ~Stop() { list.push_back({name, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()}); }
  } stop{seconds, phase};
  return work();
}

}  // namespace batten
