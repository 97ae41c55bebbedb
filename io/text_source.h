// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace batten {

/// All bytes of a file, or of standard input for "-". A regular file is mapped, not copied, and must not be changed
/// while this lives.
class TextSource {
public:
  /// Throws IoError if the file cannot be read.
  explicit TextSource(const std::filesystem::path& path);
  ~TextSource();
  TextSource(const TextSource&) = delete;
  TextSource& operator=(const TextSource&) = delete;

  std::string_view text() const { return mapped_ ? std::string_view(mapped_, size_) : std::string_view(copied_); }

  /// The text without a byte order mark. Throws InvalidInput when it is in UTF-16.
  std::string_view utf8_text() const;

  /// How messages name the source: the path as given, or "standard input".
  const std::string& name() const { return name_; }

private:
  [[noreturn]] void fail(int error) const;
  bool map(int descriptor);
  void copy(int descriptor);

  std::string name_;
  char* mapped_ = nullptr;
  std::size_t size_ = 0;  // of what is mapped
  std::string copied_;
};

}  // namespace batten
