// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace batten {

/// A file that appears under its name only when it is complete.
///
/// The bytes go to a temporary file in the same folder, which `commit` renames to the target. Without `commit` the
/// destructor removes the temporary file and the target stays as it was. A symbolic link is followed: the file it
/// points to is replaced. Not for use by several threads at once.
class OutputFile {
public:
  /// Throws IoError if the folder does not exist or cannot be written, or if the target exists and is not a regular
  /// file or is read-only.
  explicit OutputFile(const std::filesystem::path& target);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Where a foreign writer may write by itself, instead of `write`. It must report its own errors.
  const std::filesystem::path& temporary_path() const { return temporary_; }

  /// Appends bytes (buffered). Throws IoError.
  void write(std::string_view bytes);

  /// Forces the bytes to the disk and renames. Throws IoError (and leaves nothing behind) if anything failed.
  void commit();

private:
  void flush();
  [[noreturn]] void fail(int error) const;

  std::filesystem::path asked_;      // as the user wrote it, for messages
  std::filesystem::path target_;     // after following symbolic links
  std::filesystem::path temporary_;  // empty once committed
  std::string buffer_;
  int descriptor_ = -1;
};

/// Throws what OutputFile(target) would throw, and leaves nothing behind: for asking before a long computation.
void check_output(const std::filesystem::path& target);

}  // namespace batten
