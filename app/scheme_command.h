// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/subcommand.h>

namespace batten {

/// Adds `batten scheme` to the command line.
Subcommand add_scheme_command(CLI::App& app);

}  // namespace batten
