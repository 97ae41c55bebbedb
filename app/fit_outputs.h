// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/fit_arguments.h>
#include <batten/app/fit_input.h>
#include <batten/app/progress.h>
#include <batten/domains/grid_samples.h>
#include <batten/fem/fit.h>

#include <string>
#include <vector>

namespace batten {

/// The files that the arguments ask for, in the order in which they are written.
std::vector<std::string> output_files(const FitArguments& arguments);

/// Throws UsageError for unknown extensions and for a file that is the input, IoError for files that cannot
/// be written: before the work is done.
void check_outputs(const FitArguments& arguments);

/// What there is to write, once the work is done.
struct FitOutputs {
  const FitArguments* arguments;
  const FitInput* input;
  const FitResult* result;
  double aspect = 1;
  GridSamples
      grid;  ///< value, gradient and perhaps standard_error at the corners of the cells, blanked where asked for
};

/// Writes the surface, the points and the picture, as far as they are asked for.
void write_outputs(const FitOutputs& outputs, Progress& progress);

}  // namespace batten
