// SPDX-License-Identifier: MIT
// Iterations to an estimated relative error of 1e-10 in the energy norm, for random points of Franke's function: every
// energy and degree at a moderate λ, and the thin plate over λ, size and density of the points.
#include <batten/bench/support/report.h>
#include <batten/bench/support/test_surface.h>
#include <batten/fem/fit_problem.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace batten {
namespace {

/// Smooths over a length of about 0.03, a power of λ that depends on the energy's order: 1e-6 for bending, 1e-3 for the
/// membrane, for which 1e-6 would be near interpolation.
double moderate_lambda(const Energy& energy) { return energy.order() == 1 ? 1e-3 : 1e-6; }

using Cells = std::array<int, 2>;

std::string text(Cells cells) { return std::to_string(cells[0]) + "x" + std::to_string(cells[1]); }

class Count {
public:
  Count(const Observations& observations, Cells cells, const FitOptions& options)
      : region_(unit_square(cells[0], cells[1])),
        prepared_(prepare(observations, region_, options.energy, false)),
        problem_(prepared_.data, region_, options) {}

  int iterations(double lambda) {
    auto& system = problem_.system();
    system.set(lambda, problem_.weight());
    const auto b = problem_.right_side(problem_.weight(), problem_.value());
    std::vector<double> c(b.size());
    return solve(system, b, c, {.accuracy = 1e-10, .most_iterations = 500}).iterations;
  }

private:
  Rectangle region_;
  PreparedData prepared_;
  FitProblem problem_;
};

struct NamedEnergy {
  std::string name;
  Energy energy;
};

std::vector<int> count_sizes(const Observations& observations, const std::vector<Cells>& sizes,
                             const FitOptions& options) {
  std::vector<int> counts;
  for (const auto& cells : sizes)
    counts.push_back(Count(observations, cells, options).iterations(moderate_lambda(options.energy)));
  return counts;
}

void count_over_sizes(Report& report, std::size_t points) {
  const auto observations = random_observations(points);
  const std::vector<Cells> sizes = {{64, 64},     {128, 128},   {256, 256},  {512, 512},
                                    {1024, 1024}, {2048, 2048}, {1000, 700}, {1023, 509}};
  std::vector<std::string> columns = {"energy", "degree"};
  for (const auto& cells : sizes) columns.push_back(text(cells));
  report.table("iterations, lambda 1e-6 (membrane 1e-3), " + std::to_string(points) + " random points", columns);
  const std::vector<NamedEnergy> energies = {
      {"membrane", Energy::membrane()}, {"thin plate", Energy::thin_plate()}, {"tension 0.9", Energy::tension(0.9)}};
  for (const auto& energy : energies)
    for (int degree : {2, 3}) {
      const auto counts = count_sizes(observations, sizes, {.energy = energy.energy, .degree = degree});
      std::vector<Cell> row = {energy.name, degree};
      row.insert(row.end(), counts.begin(), counts.end());
      report.row(row);
      const std::string what =
          energy.name + ", degree " + std::to_string(degree) + ", " + std::to_string(points) + " points";
      report.at_most("iterations, 64^2 to 2048^2, " + what, 12, *std::max_element(counts.begin(), counts.end() - 2));
      report.at_most("iterations, 1000 x 700 and 1023 x 509, " + what, 12,
                     *std::max_element(counts.end() - 2, counts.end()));
    }
}

void count_over_lambda(Report& report, std::size_t points) {
  const auto observations = random_observations(points);
  const std::vector<double> lambdas = {1e2, 1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14};
  std::vector<std::string> columns = {"cells"};
  for (double lambda : lambdas) columns.push_back(Cell(lambda).text);
  report.table("iterations, thin plate, degree 3, " + std::to_string(points) + " random points, over lambda", columns);
  for (int cells : {128, 256, 512, 1024}) {
    Count count(observations, {cells, cells}, {});
    std::vector<Cell> row = {std::to_string(cells) + "^2"};
    for (double lambda : lambdas) row.push_back(count.iterations(lambda));
    report.row(row);
  }
}

void measure(Report& report) {
  for (const std::size_t points : {10'000, 100'000}) count_over_sizes(report, points);
  for (const std::size_t points : {2'000, 20'000, 200'000}) count_over_lambda(report, points);
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run_benchmark(argc, argv, "iterations", batten::measure); }
