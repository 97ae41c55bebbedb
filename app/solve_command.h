// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/subcommand.h>

namespace batten {

/// `batten solve`: membranes, heat and plates from a problem file.
Subcommand add_solve_command(CLI::App& app);

}  // namespace batten
