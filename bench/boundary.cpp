// SPDX-License-Identifier: MIT
// Boundary value problems: the time of full multigrid to the error of the discretisation and of solves to 1e-10,
// against the memory's; memory; iterations by size, and where coefficients jump. A membrane of degree 1 with known
// harmonic values on its sides, and a clamped plate of degree 3 with a known solution.
#include <batten/bench/support/report.h>
#include <batten/bench/support/test_surface.h>
#include <batten/bench/support/timing.h>
#include <batten/bench/support/triad.h>
#include <batten/fem/boundary_solver.h>
#include <batten/fem/boundary_system.h>
#include <batten/fem/conjugate_gradients.h>
#include <batten/fem/load_vector.h>

#include <malloc.h>
#include <omp.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

namespace batten {
namespace {

using Vector = std::vector<double>;

constexpr double pi = std::numbers::pi;
constexpr double accuracy = 1e-10;
constexpr double prototype_levels = 3, prototype_solve = 7, prototype_triad = 44;  // ns per unknown, GB/s

// u = sin πx sin πy
double half_wave(double x) { return std::sin(pi * x); }

BoundaryProblem membrane(int cells) {
  const auto side = Side::fixed();
  BoundaryProblem problem{Conduction{}, unit_square(cells, cells), 1, {side, side, side, side}, {}, {}};
  problem.loads.area = Field::Function([](double x, double y) { return 2 * pi * pi * half_wave(x) * half_wave(y); });
  return problem;
}

// w = X(x) X(y) with X = x² (1 - x)²
double clamped_beam(double x) { return x * x * (1 - x) * (1 - x); }
double its_second_derivative(double x) { return 2 - 12 * x + 12 * x * x; }

BoundaryProblem plate(int cells) {
  const auto side = Side::clamped();
  BoundaryProblem problem{KirchhoffPlate{}, unit_square(cells, cells), 3, {side, side, side, side}, {}, {}};
  problem.loads.area = Field::Function([](double x, double y) {
    return 24 * (clamped_beam(x) + clamped_beam(y)) + 2 * its_second_derivative(x) * its_second_derivative(y);
  });
  return problem;
}

/// A problem in its discrete form.
struct Discrete {
  BoundarySystem system;
  Vector b;

  explicit Discrete(const BoundaryProblem& problem) : system(problem), b(system.restricted(load_vector(problem))) {}
};

/// L2 error of a membrane's nodal values v, by two Gauss points in each cell and direction.
double membrane_error(const Vector& v) {
  const auto n = static_cast<std::ptrdiff_t>(std::sqrt(static_cast<double>(v.size())) + 0.5), cells = n - 1;
  const std::array at = {0.5 - std::sqrt(1. / 12), 0.5 + std::sqrt(1. / 12)};
  Vector wave;
  for (std::ptrdiff_t i = 0; i < cells; ++i)
    for (const double t : at) wave.push_back(half_wave((static_cast<double>(i) + t) / static_cast<double>(cells)));
  double sum = 0;
#pragma omp parallel for reduction(+ : sum)
  for (std::ptrdiff_t k = 0; k < cells * cells * 4; ++k) {
    const std::ptrdiff_t i = k / 2 % cells, j = k / (4 * cells);
    const auto a = static_cast<std::size_t>(k % 2), b = static_cast<std::size_t>(k / (2 * cells) % 2);
    const double* u = v.data() + j * n + i;
    const double value =
        (1 - at[b]) * ((1 - at[a]) * u[0] + at[a] * u[1]) + at[b] * ((1 - at[a]) * u[n] + at[a] * u[n + 1]);
    const double error = value - wave[static_cast<std::size_t>(2 * i) + a] * wave[static_cast<std::size_t>(2 * j) + b];
    sum += error * error;
  }
  return std::sqrt(sum / 4) / static_cast<double>(cells);
}

/// Relative error of the plate in the energy norm, from |w - w_h|² = |w|² - |w_h|² where that is well above rounding,
/// by its order h² elsewhere.
double plate_error(int cells) {
  constexpr int sample = 128;
  const Discrete d(plate(sample));
  Vector c(d.b.size());
  solve(d.system.multigrid(), d.b, c, {.accuracy = 1e-12});
  const double exact =
      2 * 0.8 / 630 + 2 * std::pow(2. / 105, 2);  // ∫∫ (Δw)², by ∫ X''² = 4/5, ∫ X² = 1/630, ∫ X' ²= 2/105
  const double found = std::inner_product(c.begin(), c.end(), d.b.begin(), 0.);
  return std::sqrt(std::abs(1 - found / exact)) * std::pow(double(sample) / cells, 2);
}

double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024. * static_cast<double>(usage.ru_maxrss);
}

/// Peak memory of the process so far: each problem is larger than what came before. Vectors get pages of their own, so
/// that those that are freed do not count by the gaps that they leave.
void measure_memory(Report& report) {
  constexpr int own_pages = 1 << 20, usual = 32 << 20;
  mallopt(M_MMAP_THRESHOLD, own_pages);
  report.table("peak memory of the process, bytes for each unknown", {"problem", "system", "whole library call"});
  const auto row = [&](const std::string& name, const BoundaryProblem& problem) {
    double unknowns = 0, system = 0;
    {
      const Discrete d(problem);
      Vector c(d.b.size());
      solve(d.system.multigrid(), d.b, c, {.accuracy = accuracy});
      unknowns = static_cast<double>(c.size());
      system = peak_bytes() / unknowns;
    }
    const auto result = solve_boundary_problem(problem);
    report.row({name, system, peak_bytes() / unknowns});
    report.at_most("bytes for each unknown, right-hand side and solution included, " + name, 100, system);
  };
  row("plate, 1024^2", plate(1024));
  row("membrane, 4096^2", membrane(4096));
  mallopt(M_MMAP_THRESHOLD, usual);
}

/// Nanoseconds for each unknown.
struct Cost {
  double levels = 0, solve = 0;
  IterationResult result;
};

double time_levels(const Discrete& d, Vector& c, int repeats) {
  const auto& multigrid = d.system.multigrid();
  return 1e9 / static_cast<double>(c.size()) * least_seconds(repeats, [&] { solve_by_levels(multigrid, d.b, c); });
}

Cost time_solves(const Discrete& d, Vector& c, int repeats) {
  const auto& multigrid = d.system.multigrid();
  const double unit = 1e9 / static_cast<double>(c.size());
  Cost cost;
  cost.levels = time_levels(d, c, repeats);
  cost.solve = std::numeric_limits<double>::infinity();
  for (int k = 0; k < repeats; ++k) {
    std::fill(c.begin(), c.end(), 0.);  // the start is the caller's
    const auto work = [&] { cost.result = solve(multigrid, d.b, c, {.accuracy = accuracy}); };
    cost.solve = std::min(cost.solve, unit * seconds_of(work));
  }
  return cost;
}

/// Nanoseconds for each unknown to write and read two vectors ten times.
double time_of_ten(Vector a, Vector b) {
  const auto n = static_cast<std::ptrdiff_t>(a.size());
  volatile double sink = 0;
  const double seconds = least_seconds(3, [&] {
    for (int k = 0; k < 10; ++k) {
      double sum = 0;
      double *pa = a.data(), *pb = b.data();
#pragma omp parallel for simd schedule(static)
      for (std::ptrdiff_t i = 0; i < n; ++i) pa[i] = pb[i] = k;
#pragma omp parallel for simd schedule(static) reduction(+ : sum)
      for (std::ptrdiff_t i = 0; i < n; ++i) sum += pa[i] + pb[i];
      sink = sum;
    }
  });
  return 1e9 * seconds / static_cast<double>(n);
}

const std::vector<std::string> columns = {
    "cells", "levels, ns", "1e-10, ns", "iterations", "accuracy", "triad, GB/s", "error / discretisation's"};

/// The whole solve of a problem, corrections whose residuals are formed by differences included.
Cost time_whole_solve(const BoundaryProblem& problem, int repeats) {
  Cost cost;
  cost.solve = std::numeric_limits<double>::infinity();
  for (int k = 0; k < repeats; ++k) {
    const auto found = solve_boundary_problem(problem, {.limits = {.accuracy = accuracy}});
    const auto phase = std::ranges::find(found.seconds, "solve", &PhaseTime::phase);
    cost.solve = std::min(cost.solve, 1e9 * phase->seconds / static_cast<double>(found.unknowns));
    cost.result = {found.iterations, found.accuracy};
  }
  return cost;
}

void measure_plates(Report& report, Triad& triad) {
  report.table("clamped plate, degree 3: time for each unknown of full multigrid and of the whole solve", columns);
  for (const int cells : {256, 512, 1024, 2048}) {
    const Discrete d(plate(cells));
    Vector c(d.b.size());
    const int repeats = cells > 1024 ? 4 : 8;
    const double levels = time_levels(d, c, repeats);
    const Cost whole = time_whole_solve(plate(cells), repeats);
    solve_by_levels(d.system.multigrid(), d.b, c);
    const double scale = std::sqrt(std::inner_product(c.begin(), c.end(), d.b.begin(), 0.));
    double left = 0;
    d.system.multigrid().streamed()->iterate(StreamedCycle::Begin::AtStart, d.b, c, [&](const auto& found) {
      left = found.error / scale;
      return false;
    });
    const double ratio = std::hypot(1, left / plate_error(cells)), bandwidth = 1e-9 * triad.bytes_per_second();
    const std::string size = std::to_string(cells) + "^2";
    report.row({size, levels, whole.solve, whole.result.iterations, whole.result.accuracy, bandwidth, ratio});
    if (cells < 1024) continue;
    report.at_most("plate " + size + ": ns to the error of the discretisation, triad of 40 GB/s", 40,
                   levels * bandwidth / 40);
    report.at_most("plate " + size + ": ns to 1e-10, triad of 40 GB/s", 120, whole.solve * bandwidth / 40);
    report.at_most("plate " + size + ": recomputed accuracy over 1e-10", 1, whole.result.accuracy / accuracy);
    report.at_most("plate " + size + ": error of full multigrid over the discretisation's", 1.05, ratio);
  }
}

void measure_membranes(Report& report, Triad& triad) {
  report.table("membrane, degree 1: time for each unknown of full multigrid and of a solve", columns);
  for (const int cells : {512, 1024, 2048, 4096}) {
    const Discrete d(membrane(cells));
    Vector c(d.b.size());
    const Cost cost = time_solves(d, c, 6);
    const double bandwidth = 1e-9 * triad.bytes_per_second();
    const double exact = membrane_error(c);
    solve_by_levels(d.system.multigrid(), d.b, c);
    const double ratio = membrane_error(c) / exact;
    const std::string size = std::to_string(cells) + "^2";
    report.row({size, cost.levels, cost.solve, cost.result.iterations, cost.result.accuracy, bandwidth, ratio});
    if (cells < 4096) continue;
    report.at_most("membrane: error of full multigrid over the discretisation's", 1.05, ratio);
    report.at_most("membrane: full multigrid over writing and reading two vectors ten times", 2.5,
                   cost.levels / time_of_ten(c, d.b));
    const double share = bandwidth / prototype_triad;
    report.at_most("membrane: full multigrid over the prototype's", 1.5, cost.levels * share / prototype_levels);
    report.at_most("membrane: solve to 1e-10 over the prototype's", 1.5, cost.solve * share / prototype_solve);
  }
}

/// 8 x 8 fields of 1 and 1000.
double checkerboard(double x, double y) {
  return (static_cast<int>(8 * x) + static_cast<int>(8 * y)) % 2 == 0 ? 1 : 1000;
}

void measure_checkerboards(Report& report) {
  report.table("iterations to 1e-10, 8 x 8 checkerboard of contrast 1000 and constant coefficients",
               {"cells", "membrane", "constant", "accuracy", "plate", "constant", "accuracy"});
  for (const int cells : {512, 1024, 2048}) {
    const auto solved = [](const BoundaryProblem& problem) {
      const Discrete d(problem);
      Vector c(d.b.size());
      return solve(d.system.multigrid(), d.b, c, {.accuracy = accuracy});
    };
    auto k = membrane(cells), rigidity = plate(cells);
    std::get<Conduction>(k.material).k = Field::Function(checkerboard);
    std::get<KirchhoffPlate>(rigidity.material).rigidity = Field::Function(checkerboard);
    const auto jumps = solved(k), plate_jumps = solved(rigidity);
    const int smooth = solved(membrane(cells)).iterations, plate_smooth = solved(plate(cells)).iterations;
    const std::string name = "checkerboard " + std::to_string(cells) + "^2: ";
    report.row({std::to_string(cells) + "^2", jumps.iterations, smooth, jumps.accuracy, plate_jumps.iterations,
                plate_smooth, plate_jumps.accuracy});
    report.at_most(name + "iterations of the membrane over constant", 3, 1. * jumps.iterations / smooth);
    report.at_most(name + "iterations of the plate over constant", 4, 1. * plate_jumps.iterations / plate_smooth);
    report.at_most(name + "recomputed accuracy over that asked for", 1.05,
                   std::max(jumps.accuracy, plate_jumps.accuracy) / accuracy);
  }
}

void measure(Report& report) {
  report.note("threads", omp_get_max_threads());
  measure_memory(report);
  Triad triad;
  measure_plates(report, triad);
  measure_membranes(report, triad);
  measure_checkerboards(report);
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run_benchmark(argc, argv, "boundary", batten::measure); }
