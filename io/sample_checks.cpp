// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/sample_checks.h>

namespace batten {
namespace {

void check_lengths(const std::vector<PointArray>& arrays, std::size_t places, const std::string& function) {
  for (const PointArray& array : arrays) {
    if (array.components < 1) throw InvalidInput(function + ": array '" + array.name + "' has no components");
    const std::size_t expected = places * static_cast<std::size_t>(array.components);
    if (array.values.size() == expected) continue;
    throw InvalidInput(function + ": array '" + array.name + "' must have " + std::to_string(expected) +
                       " values, it has " + std::to_string(array.values.size()));
  }
}

}  // namespace

void check_arrays(const GridSamples& grid, const std::string& function) {
  if (grid.points[0] < 1 || grid.points[1] < 1) throw InvalidInput(function + ": the grid has no points");
  const auto nx = static_cast<std::size_t>(grid.points[0]), ny = static_cast<std::size_t>(grid.points[1]);
  check_lengths(grid.arrays, nx * ny, function);
  check_lengths(grid.cell_arrays, (nx - 1) * (ny - 1), function);
}

void check_arrays(const ScatteredSamples& samples, const std::string& function) {
  if (samples.y.size() != samples.x.size() || samples.z.size() != samples.x.size()) {
    throw InvalidInput(function + ": x, y and z must have equal lengths, found " + std::to_string(samples.x.size()) +
                       ", " + std::to_string(samples.y.size()) + " and " + std::to_string(samples.z.size()));
  }
  check_lengths(samples.arrays, samples.x.size(), function);
}

}  // namespace batten
