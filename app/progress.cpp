// SPDX-License-Identifier: MIT
#include <batten/app/progress.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace batten {
namespace {

constexpr auto redraw_interval = std::chrono::milliseconds(100);
constexpr const char* erase_line = "\r\033[K";

}  // namespace

Progress::Progress(std::string command, bool quiet)
    : command_(std::move(command)), active_(!quiet && ::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() { erase(); }

void Progress::show(std::string_view phase, double done) {
  const auto now = std::chrono::steady_clock::now();
  if (!active_ || (phase == phase_ && now - drawn_ < redraw_interval)) return;
  phase_ = phase;
  drawn_ = now;
  std::string line = erase_line + command_ + ": " + phase_;
  const auto percent = static_cast<int>(std::lround(100 * std::clamp(done, 0., 1.)));
  if (percent > 0) line += ' ' + std::to_string(percent) + " %";
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

void Progress::erase() {
  if (phase_.empty()) return;
  phase_.clear();
  std::fputs(erase_line, stderr);
  std::fflush(stderr);
}

}  // namespace batten
