// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/subdivide_arguments.h>

#include <string>

namespace batten {

/// perfect-flow or slow-flow.
bool is_flow_scheme(const std::string& name);

/// Throws UsageError when an option is given that flows alone have.
void refuse_flow_options(const SubdivideArguments& arguments);

/// Subdivides a flow, or evaluates its limit, and writes and draws it. Throws UsageError, InvalidInput or IoError.
void subdivide_flow(const SubdivideArguments& arguments);

}  // namespace batten
