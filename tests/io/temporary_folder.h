// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace batten {

/// A new, empty folder that is removed with all it holds.
class TemporaryFolder {
public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// The path of `name` in the folder.
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

  /// Writes a file and returns its path.
  std::filesystem::path file(std::string_view name, std::string_view bytes) const;

  /// The names of everything in the folder, hidden files too, sorted.
  std::vector<std::string> names() const;

private:
  std::filesystem::path path_;
};

/// All bytes of a file.
std::string bytes_of(const std::filesystem::path& path);

}  // namespace batten
