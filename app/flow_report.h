// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/flow_arguments.h>
#include <batten/app/flow_input.h>
#include <batten/app/table_source.h>
#include <batten/flows/flow_fit.h>

#include <string>
#include <vector>

namespace batten {

/// What is said about a flow beside its files.
struct FlowAccount {
  const FlowArguments* arguments;
  const FlowInput* input;
  const FlowResult* result;
  std::vector<std::string> notes;     ///< what the user should know
  std::vector<std::string> warnings;  ///< what the user should look into
  std::vector<PhaseTime> seconds;     ///< of all phases, in order, and the total
  std::size_t streamlines = 0;        ///< how many were traced

  PointCounts counts() const {
    return {result->points_used, input->skipped, result->points_outside, result->points_merged};
  }
};

/// What the fit made of --smoothing and --tolerance.
SmoothingFound found_by(const FlowResult& result);

/// Writes the numbers as JSON, with the keys that docs/flows.md lists. Throws IoError.
void write_report(const FlowAccount& account);

/// Five lines at most.
std::string summary_of(const FlowAccount& account);

}  // namespace batten
