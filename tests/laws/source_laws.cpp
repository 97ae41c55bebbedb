// SPDX-License-Identifier: MIT
#include <batten/tests/laws/source_laws.h>
#include <batten/tests/laws/source_text.h>

#include <algorithm>
#include <map>
#include <ostream>
#include <regex>
#include <set>

namespace batten {
namespace {

using Folders = std::set<std::string>;

/// For each folder those whose headers it may include.
const std::map<std::string, Folders>& visible_folders() {
  static const std::map<std::string, Folders> visible = {
      {"domains", {"domains"}},
      {"bases", {"domains", "bases"}},
      {"fem", {"domains", "bases", "fem"}},
      {"flows", {"domains", "bases", "fem", "flows"}},
      {"io", {"domains", "io"}},
      {"app", {"domains", "bases", "fem", "flows", "io", "app"}},
      {"examples", {"domains", "bases", "fem", "flows", "io", "examples"}},
      {"bench", {"domains", "bases", "fem", "flows", "io", "bench"}},
      {"tests", {"domains", "bases", "fem", "flows", "io", "app", "tests"}},
  };
  return visible;
}

struct Library {
  std::string name;
  std::regex header;
  Folders folders;  ///< whose sources may include it
};

const std::vector<Library>& confined_libraries() {
  static const std::vector<Library> libraries = {
      {"VTK", std::regex(R"(^<vtk)"), {"io", "tests"}},
      {"CGAL", std::regex(R"(^<CGAL/)"), {"domains", "tests"}},
      {"Clp", std::regex(R"(^<(coin/)?Clp)"), {"bases"}},
      {"SuiteSparse",
       std::regex(R"(^<(suitesparse/)?(cholmod|umfpack|SuiteSparse)|^<Eigen/(Cholmod|UmfPack|SPQR)Support>)"),
       {"fem", "tests", "bench"}},
      {"toml++", std::regex(R"(^<toml\+\+/)"), {"app"}},
      {"muParser", std::regex(R"(^<muParser)"), {"app"}},
  };
  return libraries;
}

std::string folder_of(const std::string& name) { return name.substr(0, name.find('/')); }

bool is_header(const std::string& name) { return name.ends_with(".h"); }

/// Whether a header may include `include`, which is none of Batten's own.
bool allowed_in_header(const std::string& name, const std::string& include) {
  static const std::regex standard(R"(^<[a-z_0-9]+>$)");
  static const std::regex eigen(R"(^<Eigen/[A-Za-z]+>$)");
  static const std::regex eigen_wrapper(R"(Support>$)");
  static const std::regex boost(R"(^<boost/multiprecision/)");
  static const std::regex google_test(R"(^<(gtest|gmock)/)");
  if (std::regex_search(include, standard)) return true;
  if (std::regex_search(include, eigen)) return !std::regex_search(include, eigen_wrapper);
  if (std::regex_search(include, boost)) return name == "bases/rational.h";
  return std::regex_search(include, google_test) && folder_of(name) == "tests";
}

/// Whether a test includes a header of the tests by its place beside it: "command_run.h", "../support/laws.h".
bool is_test_support(const std::string& name, const std::string& include) {
  if (folder_of(name) != "tests" || include.front() != '"') return false;
  const std::filesystem::path place = std::filesystem::path(name).parent_path() / include.substr(1, include.size() - 2);
  return folder_of(place.lexically_normal().generic_string()) == "tests";
}

/// What is wrong with one include; empty where nothing is.
std::string fault_of(const std::string& name, const std::string& include) {
  static const std::regex own(R"(^<batten/([a-z_]+)/[^>]*>$)");
  const std::string folder = folder_of(name);
  std::smatch match;
  if (is_test_support(name, include)) return "";
  if (include.front() != '<' || include.find("..") != std::string::npos) {
    return "include " + include + ": own headers are included as <batten/folder/name.h>";
  }
  if (std::regex_match(include, match, own)) {
    const auto visible = visible_folders().find(folder);
    if (visible != visible_folders().end() && visible->second.contains(match.str(1))) return "";
    return "include " + include + ": " + folder + " must not see " + match.str(1);
  }
  for (const Library& library : confined_libraries()) {
    if (std::regex_search(include, library.header) && !library.folders.contains(folder)) {
      return "include " + include + ": " + folder + " must not see " + library.name;
    }
  }
  if (is_header(name) && !allowed_in_header(name, include)) {
    return "include " + include + ": no third-party header in a header but Eigen's";
  }
  return "";
}

void append_form(std::vector<Violation>& found, const std::string& name, std::string_view text) {
  if (!is_header(name) && !name.ends_with(".cpp")) found.push_back({name, 1, "sources end in .h or .cpp"});
  if (!visible_folders().contains(folder_of(name))) found.push_back({name, 1, "no such folder in the house"});
  if (!text.starts_with("// SPDX-License-Identifier: MIT\n")) {
    found.push_back({name, 1, "the first line must be // SPDX-License-Identifier: MIT"});
  }
  const bool once = text.starts_with("#pragma once\n") || text.find("\n#pragma once\n") != std::string_view::npos;
  if (is_header(name) && !once) found.push_back({name, 1, "a header needs #pragma once"});
  const int lines = line_count(text);
  const int most = is_header(name) ? longest_header : longest_source;
  if (lines > most) {
    found.push_back({name, lines, std::to_string(lines) + " lines, " + std::to_string(most) + " are allowed"});
  }
}

bool is_skipped(const std::filesystem::path& folder) {
  const std::string name = folder.filename().string();
  return name.starts_with(".") || name == "build" || name == "results" || exists(folder / "CMakeCache.txt");
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const Violation& violation) {
  return out << violation.file << ':' << violation.line << ": " << violation.text;
}

std::vector<std::string> source_files(const std::filesystem::path& root) {
  static const std::set<std::string> endings = {".h",   ".hh",  ".hpp", ".hxx", ".inl", ".ipp", ".tpp",
                                                ".txx", ".cpp", ".cc",  ".cxx", ".c",   ".C"};
  std::vector<std::string> names;
  for (std::filesystem::recursive_directory_iterator entry(root), end; entry != end; ++entry) {
    if (entry->is_directory() && is_skipped(entry->path())) {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file() && endings.contains(entry->path().extension().string())) {
      names.push_back(entry->path().lexically_relative(root).generic_string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<Violation> violations_of(const std::string& name, std::string_view text) {
  std::vector<Violation> found;
  append_form(found, name, text);
  const SourceText source = read_source(text);
  for (const Include& include : includes_of(source)) {
    const std::string fault = fault_of(name, include.name);
    if (!fault.empty()) found.push_back({name, include.line, fault});
  }
  for (const FunctionExtent& function : functions_of(source)) {
    if (function.lines <= longest_function) continue;
    found.push_back({name, function.line,
                     "a function of " + std::to_string(function.lines) + " lines, " + std::to_string(longest_function) +
                         " are allowed"});
  }
  return found;
}

}  // namespace batten
