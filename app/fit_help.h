// SPDX-License-Identifier: MIT
#pragma once

namespace batten {

/// What `batten fit --help` says below the options.
extern const char* const fit_help;

/// What `batten evaluate --help` says below the options.
extern const char* const evaluate_help;

}  // namespace batten
