// SPDX-License-Identifier: MIT
#include <batten/app/run_arguments.h>
#include <batten/app/thread_count.h>

#include <CLI/CLI.hpp>

namespace batten {

void add_run_options(CLI::App& parser, RunArguments& arguments, bool grouped) {
  CLI::Option* const threads =
      parser
          .add_option("--threads", arguments.threads, "default: all of the machine; the result does not depend on it")
          ->option_text("N")
          ->check(CLI::Range(1, most_threads));
  CLI::Option* const quiet = parser.add_flag("--quiet", arguments.quiet, "print errors only");
  if (!grouped) return;
  for (CLI::Option* const option : {threads, quiet}) option->group("Output");
}

}  // namespace batten
