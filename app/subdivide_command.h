// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/subcommand.h>

namespace batten {

/// `batten subdivide`.
Subcommand add_subdivide_command(CLI::App& app);

}  // namespace batten
