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
  cost.of_bound = seconds * bandwidth / solve_traffic(problem.system(), cost.iterations);
  return cost;
}

void measure(Report& report) {
  const int all_threads = omp_get_max_threads();
  Triad triad;
  report.note("threads", all_threads);
  report.note("triad array, MB", static_cast<double>(triad.array_bytes() >> 20));
  report.note("last-level cache, MB", static_cast<double>(cache_bytes() >> 20));
  double worst_bound = 0;
  for (const std::size_t points : {100'000, 10'000}) {
    const auto observations = random_observations(points);
    for (int threads = all_threads; threads >= 1; threads -= std::max(1, all_threads - 1)) {
      omp_set_num_threads(threads);
      report.table(
          std::to_string(points) + " points, thin plate, degree 3, lambda 1e-6, " + std::to_string(threads) +
              " threads",
          {"cells", "iterations", "ns/unknown/iteration", "over smallest", "bytes/unknown/iteration", "time / bound"});
      double smallest = 0, largest = 0;
      for (int cells : {256, 512, 1024, 2048}) {
        const Cost cost = cost_of_solve(cells, observations, triad);
        if (smallest == 0) smallest = cost.nanoseconds;
        largest = cost.nanoseconds;
        if (cells >= 1024 && threads == all_threads) worst_bound = std::max(worst_bound, cost.of_bound);
        report.row({std::to_string(cells) + "^2", cost.iterations, cost.nanoseconds, cost.nanoseconds / smallest,
                    cost.bytes, cost.of_bound});
      }
      if (threads == all_threads)
        report.at_most("time per unknown, 2048^2 over 256^2, " + std::to_string(points) + " points", 2,
                       largest / smallest);
    }
  }
  report.at_most("time over what memory bandwidth allows, 1024^2 and 2048^2", 3, worst_bound);
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run_benchmark(argc, argv, "multigrid", batten::measure); }
