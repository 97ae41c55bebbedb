// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/fit_arguments.h>
#include <batten/app/fit_input.h>
#include <batten/fem/fit.h>

#include <filesystem>
#include <string>
#include <vector>

namespace batten {

/// What is said about a fit beside its files.
struct FitAccount {
  const FitArguments* arguments;
  const FitInput* input;
  const FitResult* result;
  std::vector<std::string> notes;     ///< what the user should know
  std::vector<std::string> warnings;  ///< what the user should look into
  std::vector<PhaseTime> seconds;     ///< of all phases, in order, and the total
};

/// What the fit made of --smoothing and --tolerance.
SmoothingFound found_by(const FitResult& result);

/// Writes the numbers as JSON, with the keys that docs/fit.md lists. Throws IoError.
void write_report(const std::filesystem::path& path, const FitAccount& account);

/// Five lines at most.
std::string summary_of(const FitAccount& account);

/// The largest amount of memory that this process has had, in bytes.
double peak_memory();

}  // namespace batten
