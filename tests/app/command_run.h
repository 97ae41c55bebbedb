// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace batten::test {

/// Is the command under test to have VTK?
extern const bool has_vtk;

/// Does the command under test start the program that does its work?
extern const bool has_starter;

/// A new folder that the command runs in, removed at the end. `examples/data` in it leads to the data of the tree.
class Folder {
public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  void write(const std::string& name, std::string_view text) const;
  std::string read(const std::string& name) const;
  bool has(const std::string& name) const;
  /// Names of what is in the folder but `examples`, hidden ones too, sorted.
  std::vector<std::string> names() const;

private:
  std::filesystem::path path_;
};

struct RunOptions {
  std::string input;                           ///< what the command reads from standard input
  std::optional<std::size_t> file_size_limit;  ///< as on a disk with so much room
  bool on_terminal = false;                    ///< standard error is a terminal
};

struct Outcome {
  int status = -1;  ///< exit status; -1 if a signal ended it
  std::string out, err;
};

/// Runs `batten` with these arguments in the folder.
Outcome run_batten(const Folder& folder, const std::vector<std::string>& arguments, const RunOptions& options = {});

/// Runs a line of the shell in the folder; `batten` on its path is the command under test.
Outcome run_shell(const Folder& folder, const std::string& line);

/// Runs `batten` with the words of a line, and expects exit status 0.
Outcome expect_success(const Folder& folder, const std::string& line, const RunOptions& options = {});

/// A refusal: this exit status and one line on standard error that holds the message.
void expect_refusal(const Outcome& outcome, int status, const std::string& message);

/// Splits at blanks: what a shell would do with a line without quotes.
std::vector<std::string> words(const std::string& line);

std::vector<std::string> lines(const std::string& text);

/// The column of this name of a table that the command wrote; empty fields are NaN.
std::vector<double> column(const Folder& folder, const std::string& file, const std::string& name);

}  // namespace batten::test
