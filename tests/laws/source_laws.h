// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace batten {

/// A place where the sources break one of the house's laws.
struct Violation {
  std::string file;  ///< relative to the root of the tree, with slashes
  int line;
  std::string text;
};

std::ostream& operator<<(std::ostream& out, const Violation& violation);

/// The longest that a function, a header and a source may be, in lines.
inline constexpr int longest_function = 60;
inline constexpr int longest_header = 150;
inline constexpr int longest_source = 400;

/// The headers, sources and what looks like either below `root`, relative to it and sorted. Hidden folders, results/
/// and folders that CMake builds in are left out.
std::vector<std::string> source_files(const std::filesystem::path& root);

/// What the file `name` with this text breaks of:
/// - a first line with the licence, `#pragma once` in headers, no endings but .h and .cpp, no unknown top folder;
/// - include only downward (domains <- bases <- fem <- flows; io sees domains), own headers as <batten/folder/name.h>
///   (tests may name those of the tests by their place);
/// - in headers nothing but Batten, the standard library and Eigen; Boost in bases/rational.h, GoogleTest below tests/;
/// - VTK in io and tests, CGAL in domains and tests, Clp in bases, SuiteSparse in fem, tests and bench, toml++ and
///   muParser in app;
/// - the three lengths above.
std::vector<Violation> violations_of(const std::string& name, std::string_view text);

}  // namespace batten
