// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/subcommand.h>

namespace batten {

/// `batten evaluate`: a result at any points.
Subcommand add_evaluate_command(CLI::App& app);

}  // namespace batten
