// SPDX-License-Identifier: MIT
#pragma once

namespace CLI {
class App;
}

namespace batten {

/// How a command works, whatever it does.
struct RunArguments {
  int threads = 0;  ///< 0: as many as the machine offers
  bool quiet = false;
};

/// Adds --threads and --quiet; `arguments` must outlive the parser. They are listed in the group "Output" where
/// `grouped`.
void add_run_options(CLI::App& parser, RunArguments& arguments, bool grouped);

}  // namespace batten
