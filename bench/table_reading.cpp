// SPDX-License-Identifier: MIT
// Reading a million lines of three numbers, against reading the bytes of the file.
#include <batten/bench/support/places.h>
#include <batten/bench/support/point_table.h>
#include <batten/bench/support/report.h>
#include <batten/bench/support/timing.h>
#include <batten/io/table.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace batten {
namespace {

void measure(Report& report) {
  const ScratchFolder scratch;
  const std::string file = scratch.file("points.txt");
  constexpr std::size_t lines = 1'000'000;
  write_point_table(file, lines);
  const auto size = std::filesystem::file_size(file);
  std::vector<char> bytes(size);
  const double plain = least_seconds(
      5, [&] { std::ifstream(file, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(size)); });
  std::size_t rows = 0;
  const double parsed = least_seconds(5, [&] {
    rows = read_table(file, {.columns = {"x", "y", "z"}}).columns[0].size();
  });
  if (rows != lines) throw std::runtime_error("read_table lost rows");
  report.table("a million lines of three numbers, tabs between them",
               {"bytes", "parsing / reading the bytes", "numbers per microsecond"});
  report.row({size, parsed / plain, 3e-6 * static_cast<double>(rows) / parsed});
  report.at_most("seconds for a million lines (well under 1)", 0.5, parsed);
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run_benchmark(argc, argv, "table_reading", batten::measure); }
