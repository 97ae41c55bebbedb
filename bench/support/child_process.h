// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace batten {

struct ChildCommand {
  std::vector<std::string> words;    ///< program and arguments; a program without a slash is searched for in PATH
  std::string folder = ".";          ///< where it runs
  std::string output = "/dev/null";  ///< file for its standard output
};

struct ChildCost {
  double seconds = 0;            ///< wall clock, from start to exit
  double processor_seconds = 0;  ///< of all its threads
  std::size_t peak_bytes = 0;    ///< largest resident memory
};

/// Runs a program to its end. Its messages are discarded. Throws std::runtime_error if it cannot be started or fails.
ChildCost run_child(const ChildCommand& command);

/// True if a program of this name is in PATH.
bool is_installed(const std::string& program);

}  // namespace batten
