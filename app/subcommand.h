// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace batten {

/// A subcommand of `batten`: the parser that knows its options, and what to do once they are parsed.
struct Subcommand {
  CLI::App* parser;
  std::function<void()> run;
};

}  // namespace batten
