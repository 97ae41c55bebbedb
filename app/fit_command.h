// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/subcommand.h>

namespace batten {

/// `batten fit`: scattered data to the surface of least energy.
Subcommand add_fit_command(CLI::App& app);

}  // namespace batten
