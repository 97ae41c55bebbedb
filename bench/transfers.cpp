// SPDX-License-Identifier: MIT
// What the variational scheme S_k is worth between the levels of multigrid, against the refinement R_k of B-splines: as
// the start of full multigrid, and as the transfer of conjugate gradients where coefficients jump. S_k comes as the
// bell form and as the predictor Ψ_k M_k R_k, exact and from patches of r layers. All matrices are stored, all sides
// are free: patches reproduce what has no energy and know of no other sides. Loads balance, so that E u = b has
// solutions, of which any will do.
#include <batten/bench/support/galerkin_multigrid.h>
#include <batten/bench/support/report.h>
#include <batten/bench/support/timing.h>
#include <batten/fem/energy_levels.h>
#include <batten/fem/least_energy.h>
#include <batten/fem/local_scheme.h>
#include <batten/fem/variational_scheme.h>

#include <Eigen/Cholesky>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace batten {
namespace {

using Eigen::VectorXd;
using Matrix = GalerkinMultigrid::Matrix;
using Cycle = GalerkinMultigrid::Cycle;
using Levels = std::vector<SplineLevel>;  // the coarsest first

constexpr double accuracy = 1e-10;
constexpr int coarsest_cells = 4;

struct Problem {
  std::string name;
  Energy energy;
  int degree;
};

/// What stands between two levels: R, or what the predictor makes of it.
struct Form {
  std::string name;
  std::optional<Measurement> kind = {};  ///< none: R
  int layers = 0;                        ///< 0: exact
};

/// 8 x 8 fields of 1 and 1000.
std::vector<double> checkerboard(int cells) {
  std::vector<double> result;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) result.push_back((8 * i / cells + 8 * j / cells) % 2 == 0 ? 1 : 1000);
  return result;
}

Levels levels_of(const Problem& problem, int cells, std::vector<double> coefficient) {
  VariationalDomain domain{Breakpoints::uniform(0, 1, cells)};
  domain.y = domain.x;
  domain.energy = problem.energy;
  domain.degree = problem.degree;
  domain.coefficient = std::move(coefficient);
  int steps = 0;
  while (cells >> (steps + 1) >= coarsest_cells) ++steps;
  return spline_levels(domain, steps);
}

/// From coefficients on `coarse` to coefficients on `fine`.
Matrix transfer(const SplineLevel& coarse, const SplineLevel& fine, const Form& form) {
  const Matrix R = coarse.refinement(fine);
  if (!form.kind) return R;
  if (form.layers > 0) {
    const LocalScheme local(coarse, fine, *form.kind, form.layers);
    const Matrix MR = local.measurements().M * R;
    return local.sparse_matrix() * MR;
  }
  const auto M = measurement_matrix(coarse, fine, *form.kind).M;
  const Matrix MR = M * R;
  const Eigen::MatrixXd product = LeastEnergy(fine.energy(), M).matrix() * Eigen::MatrixXd(MR);
  return product.sparseView();
}

GalerkinMultigrid multigrid(const Levels& levels, const Form& form) {
  std::vector<Matrix> transfers;
  for (std::size_t k = levels.size() - 1; k > 0; --k) transfers.push_back(transfer(levels[k - 1], levels[k], form));
  const int steps = levels.front().x().degree() + 1;  // as the library
  return {levels.back().energy(), levels.back().null_space(), std::move(transfers), steps};
}

/// ∫ f N for a density that is constant in each cell, without what works on the functions without energy.
VectorXd balanced_load(const SplineLevel& level, const std::function<double(double, double)>& density) {
  const int n = level.x().cells(), side = level.x().degree() + 1;
  VectorXd b = VectorXd::Zero(level.size());
  for (int cy = 0; cy < n; ++cy)
    for (int cx = 0; cx < n; ++cx) {
      const auto w = level.cell_moments(cx, cy, {0, 0});
      const double f = density((cx + 0.5) / n, (cy + 0.5) / n);
      for (int a = 0; a < level.local_size(); ++a) b[level.function(cx + a % side, cy + a / side)] += f * w[a];
    }
  const Eigen::MatrixXd Z = level.null_space();
  return b - Z * (Z.transpose() * Z).ldlt().solve(Z.transpose() * b);
}

// ---- starts

/// Products of waves along x and y, neither constant: they balance forces and moments.
double smooth_density(double x, double y) {
  const auto wave = [](int k, double t) { return std::cos(k * std::numbers::pi * t); };
  return wave(2, x) * wave(1, y) + wave(1, x) * wave(3, y);
}

/// The solutions on the two levels of a step, for the same load, and the error of the finer one.
struct Step {
  Levels levels;  // the finest is that of the step
  VectorXd coarse, fine, load;
  double solution = 0, discretisation = 0;  ///< energy norms

  Step(const Problem& problem, int cells) : levels(levels_of(problem, cells, {})) {
    constexpr int reference = 4;  // its own error is a sixteenth or less of the measured one's square
    const Levels all = levels_of(problem, reference * cells, {});
    std::vector<VectorXd> loads = {balanced_load(all.back(), smooth_density)};
    for (std::size_t k = all.size() - 1; loads.size() < 4; --k)
      loads.push_back(all[k - 1].refinement(all[k]).transpose() * loads.back());
    const auto solved = [&](std::size_t coarser) {
      const Levels part(all.begin(), all.end() - static_cast<std::ptrdiff_t>(coarser));
      return multigrid(part, {}).solve(loads[coarser], Cycle::V, 1e-13).x;
    };
    load = loads[2];
    fine = solved(2);
    coarse = solved(3);
    const double energy = load.dot(fine);
    solution = std::sqrt(energy);
    discretisation = std::sqrt(loads[0].dot(solved(0)) - energy);  // the spaces are nested
  }
  const SplineLevel& coarse_level() const { return levels[levels.size() - 2]; }
  const SplineLevel& fine_level() const { return levels.back(); }
};

void measure_starts_of(Report& report, const Problem& problem, int cells, const std::vector<Form>& forms) {
  const Step step(problem, cells);
  const GalerkinMultigrid plain = multigrid(step.levels, {});
  const auto size = [&](const VectorXd& v) { return std::sqrt(v.dot(plain.matrix() * v)); };
  const auto add = [&](const std::string& name, VectorXd start) {
    const double before = size(start - step.fine);
    start += plain.precondition(step.load - plain.matrix() * start, Cycle::V);
    const double after = size(start - step.fine);
    report.row({problem.name, std::to_string(cells) + "^2", name, before / step.discretisation, before / step.solution,
                after / step.discretisation});
  };
  for (const Form& form : forms) add(form.name, transfer(step.coarse_level(), step.fine_level(), form) * step.coarse);
  add("bell form, exact",
      VariationalScheme(energy_levels({step.coarse_level(), step.fine_level()}), 0).apply(step.coarse));
}

constexpr Measurement averages = Measurement::CellAverages, centres = Measurement::CentreValues,
                      greville = Measurement::GrevilleValues;

std::string name_of(Measurement kind) {
  return kind == averages ? "cell averages" : kind == centres ? "centre values" : "Greville values";
}

std::vector<Form> forms(const std::vector<Measurement>& kinds, const std::vector<int>& layers) {
  std::vector<Form> result = {{"R"}};
  for (const Measurement kind : kinds)
    for (const int r : layers)
      result.push_back({name_of(kind) + (r == 0 ? ", exact" : ", r = " + std::to_string(r)), kind, r});
  return result;
}

void measure_starts(Report& report) {
  report.table("error of the coarser level's solution as a start, uniform, free sides, smooth load",
               {"problem", "cells", "start", "over the discretisation's", "relative", "after one V-cycle"});
  for (const int cells : {32, 64}) {
    measure_starts_of(report, {"membrane, degree 1", Energy::membrane(), 1}, cells,
                      forms({averages, greville}, {0, 2, 4}));
    measure_starts_of(report, {"plate, degree 2", Energy::thin_plate(), 2}, cells,
                      forms({centres, greville}, {0, 2, 4}));
    measure_starts_of(report, {"plate, degree 3", Energy::thin_plate(), 3}, cells, forms({centres}, {0, 2, 4}));
  }
}

// ---- transfers

constexpr std::array sizes = {64, 128, 256, 512};

struct Trial {
  std::string name;
  Cycle cycle;
  struct Cost {
    int iterations;
    double complexity, work, seconds;  ///< of an iteration
    double total() const { return work * iterations; }
  };
  std::vector<Cost> costs = {};  ///< on the first of the sizes
};

/// Exact ones are full matrices, and with cubics an entry of a coarse matrix has hundreds of neighbours.
int largest_size(const Problem& problem, const Form& form) {
  if (!form.kind) return sizes.back();
  if (form.layers == 0) return sizes.front();
  return problem.degree == 1 ? sizes.back() : 256;
}

/// R with both cycles, others with V-cycles: their coarse matrices are dear.
std::vector<Trial> trials(const Problem& problem, const Form& form) {
  const auto cycles = form.kind ? std::vector{Cycle::V} : std::vector{Cycle::V, Cycle::W};
  std::vector<Trial> result;
  for (const Cycle cycle : cycles) result.push_back({form.name + (cycle == Cycle::V ? ", V" : ", W"), cycle});
  for (const int cells : sizes) {
    if (cells > largest_size(problem, form)) break;
    const Levels levels = levels_of(problem, cells, checkerboard(cells));
    const GalerkinMultigrid solver = multigrid(levels, form);
    std::mt19937_64 random(1);
    const VectorXd b =
        balanced_load(levels.back(), [&](double, double) { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; });
    for (Trial& trial : result) {
      VectorXd sink;
      const int iterations = solver.solve(b, trial.cycle, accuracy).iterations;
      const double seconds =
          least_seconds(3, [&] { sink = solver.precondition(b, trial.cycle) + solver.matrix() * b; });
      trial.costs.push_back({iterations, solver.operator_complexity(), solver.work(trial.cycle), seconds});
    }
  }
  return result;
}

/// `plain` is what costs are compared with, of the same size.
void add_row(Report& report, const Problem& problem, const Trial& trial, const Trial& plain) {
  std::vector<Cell> row = {problem.name, trial.name};
  for (const auto& cost : trial.costs) row.emplace_back(cost.iterations);
  row.resize(2 + sizes.size(), "");
  const auto &last = trial.costs.back(), &other = plain.costs[trial.costs.size() - 1];
  for (const double x : {last.complexity, last.work, last.total() / other.total(), last.seconds / other.seconds})
    row.emplace_back(x);
  report.row(row);
}

void measure_transfers_of(Report& report, const Problem& problem, const std::vector<Measurement>& kinds) {
  std::optional<Trial> plain;
  for (const Form& form : forms(kinds, {1, 2, 3, 0}))
    for (const Trial& trial : trials(problem, form)) {
      if (!plain) plain = trial;
      add_row(report, problem, trial, *plain);
    }
}

void measure_transfers(Report& report) {
  std::vector<std::string> columns = {"problem", "transfer"};
  for (const int cells : sizes) columns.push_back(std::to_string(cells) + "^2");
  columns.insert(columns.end(), {"complexity", "work", "all work / R, V's", "time / R, V's"});
  report.table("iterations to 1e-10, checkerboard of contrast 1000, free sides; costs on the largest grid of the row",
               columns);
  measure_transfers_of(report, {"Poisson, degree 1", Energy::membrane(), 1}, {averages, greville});
  measure_transfers_of(report, {"Poisson, degree 3", Energy::membrane(), 3}, {centres});
  measure_transfers_of(report, {"plate, degree 3", Energy::thin_plate(), 3}, {centres});
}

void measure(Report& report) {
  Eigen::setNbThreads(1);  // matrices of coarse levels are too small to share
  report.note("threads of matrix products", 1);
  measure_starts(report);
  measure_transfers(report);
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run_benchmark(argc, argv, "transfers", batten::measure); }
