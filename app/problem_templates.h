// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace batten {

/// A commented problem file of this kind; nullptr if there is none.
const char* problem_template(const std::string& kind);

/// The kinds that there are: "poisson, plate, ...".
std::string template_kinds();

/// What `batten solve --help` says below its options.
extern const char* const solve_help;

}  // namespace batten
