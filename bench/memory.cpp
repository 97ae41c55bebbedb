// SPDX-License-Identifier: MIT
// Peak resident memory of the whole process `batten fit` for 2048 x 2048 cells and 10^6 points, for each unknown.
#include <batten/bench/support/child_process.h>
#include <batten/bench/support/places.h>
#include <batten/bench/support/point_table.h>
#include <batten/bench/support/report.h>

#include <string>

namespace batten {
namespace {

void measure(Report& report) {
  constexpr int cells = 2048, degree = 3;
  constexpr double unknowns = static_cast<double>(cells + degree) * (cells + degree);
  const ScratchFolder scratch;
  write_point_table(scratch.file("points.txt"), 1'000'000);
  report.table("batten fit, 2048 x 2048 cells, 10^6 points", {"smoothing", "peak, MB", "bytes / unknown"});
  const std::string n = std::to_string(cells);
  for (const std::string smoothing : {"1e-6", "1e-14", "auto"}) {
    const auto cost = run_child({{batten_command(),
                                  "fit",
                                  "points.txt",
                                  "--x",
                                  "x",
                                  "--y",
                                  "y",
                                  "--value",
                                  "z",
                                  "--region",
                                  "0",
                                  "1",
                                  "0",
                                  "1",
                                  "--cells",
                                  n,
                                  n,
                                  "--smoothing",
                                  smoothing,
                                  "-o",
                                  "batten" + surface_ending(),
                                  "--quiet"},
                                 scratch.path()});
    const double bytes = static_cast<double>(cost.peak_bytes) / unknowns;
    report.row({smoothing, static_cast<double>(cost.peak_bytes) / 1e6, bytes});
    report.at_most("peak memory in bytes for each unknown, smoothing " + smoothing, 400, bytes);
  }
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run_benchmark(argc, argv, "memory", batten::measure); }
