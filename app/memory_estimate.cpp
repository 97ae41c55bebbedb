// SPDX-License-Identifier: MIT
#include <batten/app/memory_estimate.h>
#include <batten/domains/errors.h>
#include <batten/domains/number_text.h>

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace batten {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

// MemAvailable of /proc/meminfo, given in kB of 1024 bytes.
double machine_memory() {
  std::ifstream file("/proc/meminfo");
  std::string line;
  while (std::getline(file, line)) {
    if (line.starts_with("MemAvailable:")) return 1024 * std::stod(line.substr(line.find(':') + 1));
  }
  return unlimited;
}

// The number that a file holds; unlimited if there is no such file or it says "max".
double limit_in(const std::filesystem::path& path) {
  double limit = unlimited;
  std::ifstream(path) >> limit;
  return limit > 0 ? limit : unlimited;
}

// The limits of the control groups above this process: version 2, and version 1 where that is in use.
double group_memory() {
  const std::filesystem::path root = "/sys/fs/cgroup";
  double least = limit_in(root / "memory" / "memory.limit_in_bytes");
  std::ifstream file("/proc/self/cgroup");
  std::string line;
  while (std::getline(file, line)) {
    if (!line.starts_with("0::/")) continue;
    std::filesystem::path group = root / line.substr(std::string("0::/").size());
    for (; group.string().size() > root.string().size(); group = group.parent_path()) {
      least = std::min(least, limit_in(group / "memory.max"));
    }
  }
  return std::min(least, limit_in(root / "memory.max"));
}

double process_memory() {
  rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  return static_cast<double>(limit.rlim_cur);
}

void check(double cells_x, double cells_y, const std::string& what, double needed) {
  const double available = available_memory();
  if (needed <= available) return;
  throw InvalidInput(what + " on " + number_text(cells_x, 10) + " x " + number_text(cells_y, 10) +
                     " cells needs about " + bytes_text(needed) + " of memory, and " + bytes_text(available) +
                     " are available; use fewer cells");
}

}  // namespace

double fit_memory(const FitSize& size) {
  // Measured at 64^2 to 2048^2 cells and 10^3 to 10^6 points; interpolation factors a matrix that couples the points.
  constexpr double per_unknown = 400, per_point = 350, per_interpolated_point = 2500, at_least = 4e7;
  const double unknowns = size.splines * (size.cells_x + size.degree) * (size.cells_y + size.degree);
  const bool couples = size.interpolates && size.points <= unknowns;
  return at_least + per_unknown * unknowns + (couples ? per_interpolated_point : per_point) * size.points;
}

double available_memory() { return std::min({machine_memory(), group_memory(), process_memory()}); }

void check_memory(const FitSize& size) { check(size.cells_x, size.cells_y, "a fit", fit_memory(size)); }

double solve_memory(const SolveSize& size) {
  // Measured at 512^2 to 1024^2 cells, degrees 1, 3 and 5.
  constexpr double of_constants = 180, of_each_entry = 11, at_least = 4e7;
  const double entries = (2. * size.degree + 1) * (2. * size.degree + 1);
  const double per_unknown = of_constants + (size.varies ? of_each_entry * entries : 0);
  return at_least + per_unknown * (size.cells_x + size.degree) * (size.cells_y + size.degree);
}

void check_memory(const SolveSize& size) { check(size.cells_x, size.cells_y, "a solution", solve_memory(size)); }

}  // namespace batten
