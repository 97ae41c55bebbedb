// SPDX-License-Identifier: MIT
#include <batten/app/output_names.h>
#include <batten/app/usage_error.h>
#include <batten/io/output_file.h>
#include <batten/io/vtk_support.h>

#include <filesystem>

namespace batten {
namespace {

namespace fs = std::filesystem;

bool needs_vtk(const std::string& extension) { return extension != ".csv" && extension != ".json"; }

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  return fs::weakly_canonical(a, error) == fs::weakly_canonical(b, error) || fs::equivalent(a, b, error);
}

}  // namespace

void check_output_name(const std::string& option, const std::string& file, std::initializer_list<const char*> endings) {
  if (file.empty()) return;
  const std::string extension = fs::path(file).extension().string();
  std::string list;
  bool is_known = false;
  for (const char* const ending : endings) {
    is_known = is_known || extension == ending;
    list += (list.empty() ? "" : " or ") + std::string(ending);
  }
  if (!is_known) throw UsageError(option + ": the name must end with " + list + ", found '" + file + "'");
  if (!has_vtk() && needs_vtk(extension))
    throw UsageError(option + ": this build of Batten has no VTK and cannot write '" + file + "'");
  check_output(file);
}

void check_not_input(const std::string& file, const std::string& input) {
  if (!file.empty() && is_same_file(file, input)) throw UsageError(file + ": is an input and would be overwritten");
}

bool is_table(const std::string& file) { return fs::path(file).extension() == ".csv"; }

}  // namespace batten
