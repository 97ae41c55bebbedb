// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/progress.h>
#include <batten/app/solve_account.h>
#include <batten/app/stopwatch.h>
#include <batten/domains/number_text.h>

#include <string>
#include <vector>

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
  /// Takes the phases of the solver, and says if it stopped above the asked accuracy.
  void end_solve(double accuracy, const std::vector<PhaseTime>& phases) {
    if (const double asked = file.limits.accuracy; accuracy > asked)
      account.notes.push_back("the accuracy is " + number_text(accuracy, 2) + "; " + number_text(asked) +
                              " was asked for");
    account.seconds.insert(account.seconds.end(), phases.begin(), phases.end());
    watch.lap();
  }
  void end_phase(const std::string& phase) { account.seconds.push_back({phase, watch.lap()}); }
};

}  // namespace batten
