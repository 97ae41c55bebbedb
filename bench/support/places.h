// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace batten {

/// The command that was built with this benchmark. Throws std::runtime_error if none was (BATTEN_BUILD_APP is off).
std::string batten_command();

/// The folder of the examples' data sets.
std::filesystem::path example_data();

/// Ending of the files that the command writes surfaces to: ".vti", or ".csv" in a build without VTK.
std::string surface_ending();

/// A folder for large temporary files, removed at the end.
class ScratchFolder {
public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

private:
  std::filesystem::path path_;
};

}  // namespace batten
