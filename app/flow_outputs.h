// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/flow_arguments.h>
#include <batten/app/flow_input.h>
#include <batten/app/progress.h>
#include <batten/domains/curve_samples.h>
#include <batten/flows/flow_fit.h>

#include <string>
#include <vector>

namespace batten {

/// The files that the arguments ask for, in the order in which they are written.
std::vector<std::string> output_files(const FlowArguments& arguments);

/// Throws UsageError for unknown extensions and for a file that is an input, IoError for files that cannot be written:
/// before the work is done.
void check_outputs(const FlowArguments& arguments);

/// What there is to write, once the work is done.
struct FlowOutputs {
  const FlowArguments* arguments;
  const FlowInput* input;
  const FlowResult* result;
  std::vector<CurveSamples> streamlines;
};

/// Writes the field, the vectors, the streamlines and the picture, as far as they are asked for.
void write_outputs(const FlowOutputs& outputs, Progress& progress);

}  // namespace batten
