// SPDX-License-Identifier: MIT
#include <batten/bench/support/places.h>

#include <unistd.h>

#include <stdexcept>
#include <system_error>

namespace batten {

std::string batten_command() {
  std::string command = BATTEN_COMMAND;
  if (command.empty()) throw std::runtime_error("this build has no command batten (BATTEN_BUILD_APP is off)");
  return command;
}

std::filesystem::path example_data() { return BATTEN_DATA; }

std::string surface_ending() { return BATTEN_SURFACE_ENDING; }

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "batten-bench-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a folder like '" + name + "'");
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace batten
