// SPDX-License-Identifier: MIT
// The parts of an iteration on 1024 x 1024 cells, one by one; "of_triad" is the share of the triad's bandwidth at which
// each moves the bytes that it must. Google Benchmark's options apply.
#include <batten/bench/support/test_surface.h>
#include <batten/bench/support/traffic.h>
#include <batten/bench/support/triad.h>
#include <batten/fem/fit_problem.h>

#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

namespace batten {
namespace {

struct Case {
  Case(const Observations& observations, int cells)
      : region(unit_square(cells, cells)),
        prepared(prepare(observations, region, options.energy, false)),
        problem(prepared.data, region, options),
        in(problem.system().size(), 1.),
        out(in.size()),
        coarse(problem.hierarchy()[1].space.size(), 1.) {
    problem.system().set(1e-6, problem.weight());
  }

  FitOptions options;
  Rectangle region;
  PreparedData prepared;
  FitProblem problem;
  std::vector<double> in, out, coarse;
};

/// Times `work`, which must move `bytes`.
template <typename Work>
void add(const std::string& name, double bytes, double bandwidth, Work work) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [=](benchmark::State& state) {
                                 for (auto _ : state) work();
                                 state.counters["of_triad"] =
                                     benchmark::Counter(static_cast<double>(state.iterations()) * bytes / bandwidth,
                                                        benchmark::Counter::kIsRate);
                               })
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

void add_all(Case& few, Case& many, double bandwidth) {
  auto& problem = few.problem;
  const auto& level = problem.hierarchy().finest();
  const double n = 8. * static_cast<double>(few.in.size()), coarse = 8. * static_cast<double>(few.coarse.size());
  const double points = static_cast<double>(problem.size()) * (sizeof(PointRow) + 8.);
  add("energy_product", 2 * n, bandwidth, [&] { level.energy.apply(few.in, few.out); });
  add("refinement", n + coarse, bandwidth, [&] { level.refinement->apply(few.coarse, few.out); });
  add("restriction", n + coarse, bandwidth, [&] { level.restriction->apply(few.in, few.coarse); });
  add("data_product/points:100000", 3 * n + points, bandwidth,
      [&] { problem.system().data().add_normal(1, few.in, few.out); });
  add("data_product/stencil", 28 * n, bandwidth,
      [&] { many.problem.system().data().add_normal(1, many.in, many.out); });
  add("v_cycle/points:100000", cycle_traffic(problem.system()), bandwidth,
      [&] { problem.system().precondition(few.in, few.out); });
  add("v_cycle/stencil", cycle_traffic(many.problem.system()), bandwidth,
      [&] { many.problem.system().precondition(many.in, many.out); });
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) {
  std::string out = std::string("--benchmark_out=") + (argc > 1 && argv[1][0] != '-' ? argv[1] : "kernels.json");
  std::string format = "--benchmark_out_format=json";
  std::vector<char*> arguments = {argv[0], out.data(), format.data()};
  for (int k = 1; k < argc; ++k)
    if (argv[k][0] == '-') arguments.push_back(argv[k]);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  const double bandwidth = batten::Triad().bytes_per_second();
  batten::Case few(batten::random_observations(100'000), 1024);
  batten::Case many(batten::random_observations(1'200'000), 1024);
  batten::add_all(few, many, bandwidth);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
