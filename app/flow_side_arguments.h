// SPDX-License-Identifier: MIT
#pragma once

#include <batten/flows/flow_sides.h>

#include <string>

namespace CLI {
class App;
}

namespace batten {

/// What the command line says about the sides of a flow.
struct FlowSideArguments {
  std::string walls = "none", no_slip = "none", periodic = "none";
};

/// Adds --walls, --no-slip and --periodic to a group; `arguments` must outlive the parser.
void add_side_options(CLI::App& parser, FlowSideArguments& arguments, const std::string& group);

/// Throws UsageError for sides that do not exist and those that are named twice.
FlowSides sides_of(const FlowSideArguments& arguments);

/// "free", "wall", "no-slip" or "periodic".
const char* side_name(FlowSide side);

}  // namespace batten
