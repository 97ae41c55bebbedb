// SPDX-License-Identifier: MIT
// The solver against a direct one: multigrid and CHOLMOD's supernodal factorisation on the same matrix, a thin plate of
// bicubic splines through 10^5 random points of Franke's function, λ = 1e-6, at equal error in the energy norm.
#include <batten/bench/support/report.h>
#include <batten/bench/support/supernodal_cholesky.h>
#include <batten/bench/support/test_surface.h>
#include <batten/bench/support/timing.h>
#include <batten/fem/difference_form.h>
#include <batten/fem/fit_problem.h>

#include <omp.h>
#include <unistd.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace batten {
namespace {

using Vector = std::vector<double>;

constexpr double lambda = 1e-6;

/// The lower triangle of A, column by column.
Eigen::SparseMatrix<double> assemble(const FitProblem& problem) {
  const auto& level = problem.hierarchy().finest();
  DataTerm data(level.space, problem.points(), true);
  data.set_weights(problem.weight());
  const int d = problem.hierarchy().degree(), nx = level.space.x.size(), ny = level.space.y.size();
  std::vector<int> starts = {0}, rows;
  Vector values;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      for (int dy = 0; dy <= std::min(d, ny - 1 - j); ++dy)
        for (int dx = dy == 0 ? 0 : std::max(-d, -i); dx <= std::min(d, nx - 1 - i); ++dx) {
          rows.push_back((j + dy) * nx + i + dx);
          values.push_back(lambda * level.energy.entry(i, j, i + dx, j + dy) + data.stencil().entry(i, j, dx, dy));
        }
      starts.push_back(static_cast<int>(rows.size()));
    }
  return Eigen::Map<const Eigen::SparseMatrix<double>>(nx * ny, nx * ny, starts.back(), starts.data(), rows.data(),
                                                       values.data());
}

/// sqrt(e·A e) without cancellation: λ E(e) by differences, plus the squares of e at the points.
double energy_norm(const FitProblem& problem, const Vector& e) {
  Vector at_points(problem.size());
  problem.system().data().values(e, at_points);
  double sum = lambda * evaluate_energy(problem.hierarchy().energy(), problem.hierarchy().finest().space, e);
  for (std::size_t i = 0; i < at_points.size(); ++i) sum += problem.weight()[i] * at_points[i] * at_points[i];
  return std::sqrt(sum);
}

Vector difference(const Vector& a, const Vector& b) {
  Vector result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] - b[i];
  return result;
}

/// c += A^-1 (b - A c), with A c from the operator, which keeps the digits that the assembled matrix has lost.
void refine(const FitProblem& problem, SupernodalCholesky& direct, const Vector& b, Vector& c) {
  Vector r(b.size());
  problem.system().apply(c, r);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = b[i] - r[i];
  direct.solve(r);
  for (std::size_t i = 0; i < r.size(); ++i) c[i] += r[i];
}

struct Direct {
  double analysis = 0, factor = 0, solution = 0, refinement = 0;  ///< seconds
  double error = 0, refined_error = 0, reference_error = 0;       ///< relative, in the energy norm
  Vector reference;
};

Direct solve_directly(const FitProblem& problem, const Vector& b) {
  auto matrix = assemble(problem);
  Direct result;
  std::optional<SupernodalCholesky> direct;
  result.analysis = seconds_of([&] { direct.emplace(std::move(matrix)); });
  const double available = static_cast<double>(sysconf(_SC_AVPHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (1.3 * static_cast<double>(direct->factor_bytes()) > available) return {};
  result.factor = seconds_of([&] { direct->factor(); });
  Vector c = b;
  result.solution = seconds_of([&] { direct->solve(c); });
  const Vector first = c;
  result.refinement = seconds_of([&] { refine(problem, *direct, b, c); });
  const Vector refined = c;
  for (int k = 0; k < 3; ++k) refine(problem, *direct, b, c);
  const Vector before = c;
  refine(problem, *direct, b, c);
  const double size = energy_norm(problem, c);
  result.error = energy_norm(problem, difference(first, c)) / size;
  result.refined_error = energy_norm(problem, difference(refined, c)) / size;
  result.reference_error = energy_norm(problem, difference(before, c)) / size;
  result.reference = std::move(c);
  return result;
}

struct Iterative {
  double set_up = 0, solution = 0, error = 0;
  int iterations = 0;
};

Iterative solve_by_multigrid(FitProblem& problem, const Vector& b, const Vector& reference, double accuracy) {
  Iterative result;
  Vector c(b.size());
  result.set_up = least_seconds(3, [&] {
    Multigrid system(problem.hierarchy(), problem.points());
    system.set(lambda, problem.weight());
  });
  result.solution = least_seconds(3, [&] {
    std::fill(c.begin(), c.end(), 0.);
    result.iterations = solve(problem.system(), b, c, {.accuracy = accuracy}).iterations;
  });
  result.error = energy_norm(problem, difference(c, reference)) / energy_norm(problem, reference);
  return result;
}

/// Multigrid at the loosest accuracy that is as good as the direct solver's error, as far as the reference can tell.
Iterative match(FitProblem& problem, const Vector& b, const Direct& direct, double error) {
  Iterative result;
  for (double accuracy : {1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13}) {
    result = solve_by_multigrid(problem, b, direct.reference, accuracy);
    if (result.error <= error + direct.reference_error) break;
  }
  return result;
}

/// Prints the rows of one size, a pair of equal error in each.
void compare(Report& report, int cells, const Observations& observations) {
  FitOptions options;
  const Rectangle region = unit_square(cells, cells);
  const auto prepared = prepare(observations, region, options.energy, false);
  FitProblem problem(prepared.data, region, options);
  problem.system().set(lambda, problem.weight());
  const auto b = problem.right_side(problem.weight(), problem.value());
  const Direct direct = solve_directly(problem, b);
  const std::string size = std::to_string(cells) + "^2";
  if (direct.reference.empty()) {
    report.note("not measured", "CHOLMOD's factor at " + size + " does not fit into the free memory");
    return;
  }
  report.note("relative error of the reference solution at " + size, direct.reference_error);
  const int all_threads = omp_get_max_threads();
  for (int threads : {1, all_threads}) {
    omp_set_num_threads(threads);
    for (bool refined : {false, true}) {
      const double error = refined ? direct.refined_error : direct.error;
      const double seconds = direct.analysis + direct.factor + direct.solution + (refined ? direct.refinement : 0);
      const Iterative fast = match(problem, b, direct, error);
      const double ratio = seconds / (fast.set_up + fast.solution);
      report.row(
          {size, threads, refined ? "yes" : "no", error, fast.error, fast.iterations, seconds / fast.solution, ratio});
      if (refined)
        report.at_least("CHOLMOD's time over multigrid's with set-up, " + size + ", threads " + std::to_string(threads),
                        20, ratio);
    }
    if (all_threads == 1) break;
  }
  omp_set_num_threads(all_threads);
}

void measure(Report& report) {
  report.note("BLAS of CHOLMOD", use_one_blas_thread());
  const auto observations = random_observations(100'000);
  report.table(
      "CHOLMOD (analysis, factor, solution) over multigrid at equal error: thin plate, degree 3, lambda 1e-6, 10^5 "
      "points",
      {"cells", "threads", "refined", "CHOLMOD error", "multigrid error", "iterations", "over solve",
       "over set-up and solve"});
  for (int cells : {512, 1024}) compare(report, cells, observations);
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run_benchmark(argc, argv, "cholmod", batten::measure); }
