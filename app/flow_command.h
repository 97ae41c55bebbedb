// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/subcommand.h>

namespace batten {

/// `batten flow`: vectors to the vector field of least energy.
Subcommand add_flow_command(CLI::App& app);

}  // namespace batten
