// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/flow_arguments.h>
#include <batten/domains/rectangle.h>
#include <batten/flows/flow_fit.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace batten {

/// The vectors of a table.
struct FlowInput {
  VectorObservations observations;
  std::array<std::string, 4> names;  ///< of the columns x, y, u, v
  std::vector<std::size_t> lines;    ///< of the file, for messages
  std::size_t skipped = 0;           ///< rows left out because of --skip-invalid
};

/// Throws IoError or InvalidInput, naming file, line and column.
FlowInput read_flow_input(const FlowArguments& arguments);

/// The grid that the arguments ask for. Throws InvalidInput if it is none, or needs more memory than there is.
Rectangle grid_of(const FlowArguments& arguments, const VectorObservations& observations);

/// "line 17 at (2.5, 3)": where observation i comes from.
std::string place_of(const FlowInput& input, std::size_t i);

}  // namespace batten
