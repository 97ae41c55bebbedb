// SPDX-License-Identifier: MIT
// The program that does the work of the command `batten`. One file per subcommand.
#include <batten/app/evaluate_command.h>
#include <batten/app/fit_command.h>
#include <batten/app/flow_command.h>
#include <batten/app/scheme_command.h>
#include <batten/app/solve_command.h>
#include <batten/app/subdivide_command.h>
#include <batten/app/usage_error.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <new>
#include <string>
#include <vector>

namespace batten {
namespace {

constexpr int failure = 1, usage_failure = 2;

// One line on standard error.
int report_error(const std::string& command, std::string text, int status) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::cerr << command << ": " << text << std::endl;
  return status;
}

std::string name_of(const CLI::App& app) {
  const auto parsed = app.get_subcommands();
  return parsed.empty() ? "batten" : "batten " + parsed.front()->get_name();
}

// Help and version are errors to CLI11, too: those it prints itself.
int report_parse_error(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);
  const std::string command = name_of(app);
  return report_error(command, std::string(error.what()) + " (see " + command + " --help)", usage_failure);
}

// A first word that is no subcommand; CLI11 would only call it unexpected.
std::string unknown_command(const std::vector<Subcommand>& commands, int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "";
  std::string names;
  for (const Subcommand& command : commands) {
    if (command.parser->get_name() == word) return {};
    names += (names.empty() ? "" : ", ") + command.parser->get_name();
  }
  if (word.empty() || word.starts_with('-')) return {};
  return "there is no command '" + word + "'; the commands are " + names;
}

int run_parsed(const CLI::App& app, const std::vector<Subcommand>& commands) {
  const std::string name = name_of(app);
  try {
    for (const Subcommand& command : commands) {
      if (command.parser->parsed()) command.run();
    }
    return 0;
  } catch (const UsageError& error) {
    return report_error(name, error.what(), usage_failure);
  } catch (const std::bad_alloc&) {
    return report_error(name, "there is not enough memory; use fewer cells", failure);
  } catch (const std::exception& error) {
    return report_error(name, error.what(), failure);
  }
}

int run(int argc, char** argv) {
  CLI::App app("Curves, surfaces and flows of least energy, and subdivision schemes", "batten");
  app.set_version_flag("--version", "batten " BATTEN_VERSION);
  app.set_help_flag("-h,--help", "print this help and exit");
  app.footer("batten COMMAND --help explains each command.");
  app.require_subcommand(1);
  const std::vector<Subcommand> commands = {add_fit_command(app),    add_evaluate_command(app),
                                            add_flow_command(app),   add_solve_command(app),
                                            add_scheme_command(app), add_subdivide_command(app)};
  if (argc <= 1) {
    std::cout << app.help();
    return 0;
  }
  if (const std::string text = unknown_command(commands, argc, argv); !text.empty()) {
    return report_error("batten", text, usage_failure);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return report_parse_error(app, error);
  }
  return run_parsed(app, commands);
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run(argc, argv); }
