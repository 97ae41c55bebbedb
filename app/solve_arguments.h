// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace batten {

/// The command line of `batten solve`.
struct SolveArguments {
  std::string problem;        ///< the file
  std::string template_kind;  ///< print this template instead
  std::string output, picture, report;
  int threads = 0;  ///< 0: as many as the machine offers
  bool quiet = false;
};

}  // namespace batten
