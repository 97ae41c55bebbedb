// SPDX-License-Identifier: MIT
// Whole processes: `batten fit` and `gmt surface -T0` (minimum curvature, default tolerance) from the same text file of
// points of Franke's function to a file of 1024 x 1024 cells. Time, and root mean square error against the function at
// the grid's nodes.
#include <batten/bench/support/child_process.h>
#include <batten/bench/support/places.h>
#include <batten/bench/support/point_table.h>
#include <batten/bench/support/report.h>
#include <batten/bench/support/test_surface.h>
#include <batten/fem/solution.h>
#include <batten/io/image_file.h>
#include <batten/io/table.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace batten {
namespace {

constexpr int cells = 1024;

struct Error {
  double whole = 0, inner = 0;  ///< root mean square, on the square and on [0.05, 0.95]²
};

Error error_of(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& value) {
  Error sum;
  double count = 0, inner_count = 0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const double e = value[i] - franke(x[i], y[i]);
    const bool inner = std::max(std::abs(x[i] - 0.5), std::abs(y[i] - 0.5)) <= 0.45;
    sum.whole += e * e;
    ++count;
    sum.inner += inner ? e * e : 0;
    inner_count += inner;
  }
  if (value.size() != std::size_t{cells + 1} * (cells + 1))
    throw std::runtime_error("a grid has a wrong number of nodes");
  return {std::sqrt(sum.whole / count), std::sqrt(sum.inner / inner_count)};
}

/// Of a surface that the command wrote.
Error error_of_surface(const std::string& file) {
  if (surface_ending() == ".csv") {
    const Table table = read_table(file, {});
    return error_of(table.columns[0], table.columns[1], table.columns[2]);
  }
  const auto grid = Solution::from_record(read_record(file)).samples();
  std::vector<double> x, y;
  for (int j = 0; j < grid.points[1]; ++j)
    for (int i = 0; i < grid.points[0]; ++i) {
      x.push_back(grid.origin[0] + i * grid.spacing[0]);
      y.push_back(grid.origin[1] + j * grid.spacing[1]);
    }
  return error_of(x, y, grid.arrays.front().values);
}

/// Of a grid that GMT wrote, which GMT itself turns into triples of doubles.
Error error_of_grid(const ScratchFolder& scratch) {
  run_child({{"gmt", "grd2xyz", "gmt.nc", "-bo3d"}, scratch.path(), scratch.file("gmt.bin")});
  std::ifstream in(scratch.file("gmt.bin"), std::ios::binary);
  std::vector<double> x, y, z;
  for (std::array<double, 3> p{}; in.read(reinterpret_cast<char*>(p.data()), sizeof p);) {
    x.push_back(p[0]);
    y.push_back(p[1]);
    z.push_back(p[2]);
  }
  return error_of(x, y, z);
}

ChildCommand gmt_surface(const ScratchFolder& scratch) {
  return {{"gmt", "surface", "points.txt", "-R0/1/0/1", "-I0.0009765625", "-T0", "-Ggmt.nc",
           "--IO_NC4_DEFLATION_LEVEL=0", "--GMT_HISTORY=false"},
          scratch.path()};
}

ChildCommand batten_fit(const ScratchFolder& scratch, const std::string& smoothing) {
  const std::string n = std::to_string(cells);
  return {{batten_command(),
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
          scratch.path()};
}

struct Contest {
  ChildCost gmt, batten;  ///< the fastest of a few runs, taken in turns
};

ChildCost faster(const ChildCost& a, const ChildCost& b) { return a.seconds < b.seconds ? a : b; }

Contest run_both(const ScratchFolder& scratch, const std::string& smoothing) {
  constexpr int runs = 3;
  Contest best;
  best.gmt.seconds = best.batten.seconds = std::numeric_limits<double>::infinity();
  for (int k = 0; k < runs; ++k) {
    best.gmt = faster(best.gmt, run_child(gmt_surface(scratch)));
    best.batten = faster(best.batten, run_child(batten_fit(scratch, smoothing)));
    if (best.batten.seconds > 20) break;
  }
  return best;
}

void compare(Report& report, std::size_t points) {
  const ScratchFolder scratch;
  write_point_table(scratch.file("points.txt"), points);
  for (const std::string smoothing : {"1e-14", "auto"}) {
    const Contest cost = run_both(scratch, smoothing);
    const Error gmt = error_of_grid(scratch), batten = error_of_surface(scratch.file("batten" + surface_ending()));
    const double time = cost.batten.seconds / cost.gmt.seconds;
    report.row({points, smoothing, time, cost.batten.processor_seconds / cost.gmt.processor_seconds,
                gmt.whole / batten.whole, gmt.inner / batten.inner, batten.whole, batten.inner});
    if (points < 1'000'000) continue;
    report.at_most("time over GMT's, 10^6 points, smoothing " + smoothing, 1.5, time);
    report.at_least("GMT's error over ours, inner 90 %, smoothing " + smoothing, 100, gmt.inner / batten.inner);
    report.at_least("GMT's error over ours, whole square, smoothing " + smoothing, 30, gmt.whole / batten.whole);
  }
}

void measure(Report& report) {
  if (!is_installed("gmt")) {
    report.note("not measured", "GMT is not installed (Debian package gmt)");
    return;
  }
  report.table("batten fit against gmt surface -T0, 1024 x 1024 cells, Franke's function",
               {"points", "smoothing", "time / GMT", "processor time / GMT", "GMT error / ours", "the same, inner 90 %",
                "our rms error", "our inner"});
  for (const std::size_t points : {10'000, 100'000, 1'000'000}) compare(report, points);
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run_benchmark(argc, argv, "gmt", batten::measure); }
