// SPDX-License-Identifier: MIT
#pragma once

#include <batten/app/scheme_arguments.h>

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace batten {

/// Adds the options that make a scheme, which set `arguments`; it must live as long as the parser.
void add_making_options(CLI::App& parser, SchemeArguments& arguments);

/// Adds those that make a quotient of masks.
void add_quotient_options(CLI::App& parser, SchemeArguments& arguments);

/// Those of these options that were given.
std::vector<std::string> making_options_given(const SchemeArguments& arguments);

}  // namespace batten
