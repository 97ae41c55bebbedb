// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace batten {

/// One line on a terminal that says what is being done, overwritten as the work goes on and erased at the end.
/// Shows nothing where standard error is not a terminal.
class Progress {
public:
  /// `command` opens the line: "batten fit".
  Progress(std::string command, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done`: the part of the phase that is done, from 0 to 1. Redrawn at most ten times a second within a phase.
  void show(std::string_view phase, double done = 0);
  void erase();

private:
  std::string command_;
  bool active_;
  std::string phase_;
  std::chrono::steady_clock::time_point drawn_;
};

}  // namespace batten
