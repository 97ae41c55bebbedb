// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/subcommand.h>

namespace batten {

/// `batten solve`: membranes, heat, plates and slow flows from a problem file.
Subcommand add_solve_command(CLI::App& app);

}  // namespace batten
