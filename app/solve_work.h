// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/progress.h>
#include <batten/app/solve_account.h>
#include <batten/app/stopwatch.h>

#include <string>

namespace batten {

/// What every kind of solution works with.
struct SolveWork {
  const SolveArguments& arguments;
  const ProblemFile& file;
  Progress& progress;
  SolveAccount& account;
  Stopwatch watch = {};

  BoundarySolveOptions options() const {
    return {file.limits, [this](std::string_view phase, double done) { progress.show(phase, done); }};
  }
  void end_phase(const std::string& phase) { account.seconds.push_back({phase, watch.lap()}); }
};

}  // namespace batten
