// SPDX-License-Identifier: MIT
#pragma once

namespace batten {

/// What `batten flow --help` says below the options.
extern const char* const flow_help;

}  // namespace batten
