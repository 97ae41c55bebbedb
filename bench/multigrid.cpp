// SPDX-License-Identifier: MIT
// The cost of the solver: a thin plate of bicubic splines through random points of Franke's function, λ = 1e-6, from
// 256² to 2048² cells. Time for each unknown and iteration, against the time in which the memory moves the bytes of an
// iteration.
#include <batten/bench/support/report.h>
#include <batten/bench/support/test_surface.h>
#include <batten/bench/support/timing.h>
#include <batten/bench/support/traffic.h>
#include <batten/bench/support/triad.h>
#include <batten/fem/fit_problem.h>

#include <omp.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace batten {
namespace {

constexpr double lambda = 1e-6;
constexpr double accuracy = 1e-10;

struct Cost {
  int iterations = 0;
  double nanoseconds = 0;  ///< of the solve, for each unknown and iteration
  double bytes = 0;        ///< that must be moved for each unknown and iteration
  double of_bound = 0;     ///< time of the solve over that in which the memory moves its bytes
};

Cost cost_of_solve(int cells, const Observations& observations, Triad& triad) {
  FitOptions options;
  const Rectangle region = unit_square(cells, cells);
  const auto prepared = prepare(observations, region, options.energy, false);
  FitProblem problem(prepared.data, region, options);
  problem.system().set(lambda, problem.weight());
  const auto b = problem.right_side(problem.weight(), problem.value());
  std::vector<double> c(b.size());
  Cost cost;
  const auto run = [&] {
    std::fill(c.begin(), c.end(), 0.);
    cost.iterations = solve(problem.system(), b, c, {.accuracy = accuracy}).iterations;
  };
  double bandwidth = triad.bytes_per_second();
  const double seconds = least_seconds(cells > 1024 ? 3 : 6, run);
  bandwidth = std::max(bandwidth, triad.bytes_per_second());
  cost.nanoseconds = 1e9 * seconds / static_cast<double>(b.size()) / cost.iterations;
  cost.bytes = iteration_traffic(problem.system()) / static_cast<double>(b.size());
  if (problem.system().is_data_aware()) throw std::logic_error("the traffic of data-aware smoothing is not counted");
  cost.of_bound = seconds * bandwidth / solve_traffic(problem.system(), cost.iterations);
  return cost;
}

struct Extremes {
  double growth = 0;       ///< time for each unknown and iteration, largest over smallest size
  double worst_bound = 0;  ///< of the sizes that no cache holds
};

Extremes measure_sizes(Report& report, const Observations& observations, int threads, Triad& triad) {
  omp_set_num_threads(threads);
  report.table(
      "thin plate, degree 3, lambda 1e-6, " + std::to_string(observations.size()) +
          " points, threads: " + std::to_string(threads),
      {"cells", "iterations", "ns / unknown / iteration", "over 256^2", "bytes / unknown / iteration", "time / bound"});
  Extremes result;
  double smallest = 0;
  for (int cells : {256, 512, 1024, 2048}) {
    const Cost cost = cost_of_solve(cells, observations, triad);
    if (smallest == 0) smallest = cost.nanoseconds;
    result.growth = cost.nanoseconds / smallest;
    if (cells >= 1024) result.worst_bound = std::max(result.worst_bound, cost.of_bound);
    report.row(
        {std::to_string(cells) + "^2", cost.iterations, cost.nanoseconds, result.growth, cost.bytes, cost.of_bound});
  }
  return result;
}

void measure(Report& report) {
  const int all_threads = omp_get_max_threads();
  Triad triad;
  report.note("threads of the goals", all_threads);
  report.note("triad: MB of each of three arrays", static_cast<double>(triad.array_bytes() >> 20));
  report.note("largest cache that the system reports, MB", static_cast<double>(cache_bytes() >> 20));
  for (const std::size_t points : {100'000, 10'000}) {
    const auto observations = random_observations(points);
    const std::string text = ", " + std::to_string(points) + " points";
    if (all_threads > 1) measure_sizes(report, observations, 1, triad);
    const Extremes found = measure_sizes(report, observations, all_threads, triad);
    report.at_most("time per unknown and iteration, 2048^2 over 256^2" + text, 2, found.growth);
    report.at_most("time over what memory bandwidth allows, 1024^2 and 2048^2" + text, 3, found.worst_bound);
  }
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run_benchmark(argc, argv, "multigrid", batten::measure); }
