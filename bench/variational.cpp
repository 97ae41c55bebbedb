// SPDX-License-Identifier: MIT
// Variational schemes: how fast the error of local rules falls with their reach, in the interpolating form and in the
// bell form of the source; what the predictor's energies are; and that deriving and applying local rules takes time
// linear in the unknowns, on an uneven interval of 10^5 knots, a masked rectangle of 513² grid points and a coefficient
// of contrast 1000 there.
#include <batten/bench/support/report.h>
#include <batten/bench/support/timing.h>
#include <batten/fem/energy_levels.h>
#include <batten/fem/least_energy.h>
#include <batten/fem/local_scheme.h>
#include <batten/fem/padded_scheme.h>
#include <batten/fem/predictor.h>
#include <batten/fem/variational_scheme.h>

#include <Eigen/QR>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace batten {
namespace {

using Eigen::VectorXd;

VectorXd random_numbers(Eigen::Index n, unsigned seed) {
  std::mt19937_64 random(seed);
  VectorXd v(n);
  for (double& x : v) x = static_cast<double>(random() >> 11) * 0x1p-52 - 1;
  return v;
}

struct Problem {
  std::string name;
  VariationalDomain domain;
  Measurement kind;
};

/// n x n unit cells, or n cells on a line.
VariationalDomain grid(const Energy& energy, int degree, int n, bool line = false) {
  VariationalDomain result{Breakpoints::uniform(0, n, n)};
  if (!line) result.y = result.x;
  result.energy = energy;
  result.degree = degree;
  return result;
}

/// From 1 to 1000, log-uniform.
VariationalDomain with_contrast(VariationalDomain domain) {
  const auto cells = static_cast<Eigen::Index>(domain.x.cells()) * domain.rows();
  for (double v : random_numbers(cells, 4)) domain.coefficient.push_back(std::pow(1000, (v + 1) / 2));
  return domain;
}

VariationalDomain with_checkerboard(VariationalDomain domain) {
  for (int j = 0; j < domain.rows(); ++j)
    for (int i = 0; i < domain.x.cells(); ++i) domain.coefficient.push_back((i + j) % 2 == 0 ? 1 : 1000);
  return domain;
}

/// A square with a round hole and a cut-off corner.
VariationalDomain with_mask(VariationalDomain domain) {
  const int n = domain.x.cells();
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double x = (i + 0.5) / n, y = (j + 0.5) / n;
      domain.inside.push_back(std::hypot(x - 0.35, y - 0.6) > 0.2 && x + y < 1.6);
    }
  return domain;
}

/// Widths of cells from 1 to 3.
VariationalDomain uneven_line(int cells) {
  std::vector<double> x = {0};
  for (double v : random_numbers(cells, 2)) x.push_back(x.back() + 2 + v);
  VariationalDomain result{Breakpoints(x)};
  result.energy = Energy::thin_plate();
  result.degree = 3;
  return result;
}

void measure_layers(Report& report, const Problem& problem) {
  const auto levels = spline_levels(problem.domain, 1);
  const auto M = measurement_matrix(levels[0], levels[1], problem.kind).M;
  const VectorXd m = M * (levels[0].refinement(levels[1]) * random_numbers(levels[0].size(), 7));
  const VectorXd best = LeastEnergy(levels[1].energy(), M).apply(m);
  const double least = levels[1].energy_of(best);
  double before = 0, moment = 0, excess_of_four = 0;
  for (int layers = 1; layers <= 5; ++layers) {
    const LocalScheme local(levels[0], levels[1], problem.kind, layers);
    const VectorXd q = local.apply(m);
    const double error = std::sqrt(levels[1].energy_of(q - best) / least), excess = levels[1].energy_of(q) / least - 1;
    report.row({problem.name, layers, local.rules(), error, layers == 1 ? Cell("") : Cell(before / error), excess});
    moment += (layers - 3) * std::log(error);
    before = error;
    if (layers == 4) excess_of_four = excess;
  }
  report.at_least("fall of the error for each layer, " + problem.name, 3, std::exp(-moment / 10));
  report.at_most("energy predicted with four layers over the least, minus 1, " + problem.name, 1e-3, excess_of_four);
}

/// The bell form: padded rules of ever larger small domains against the exact scheme, whose range the membrane's
/// Greville values give to both.
void measure_padding(Report& report, const std::string& name, VariationalDomain small, int degree) {
  const int n = 32;
  auto large = small;
  large.x = large.y.emplace(Breakpoints::uniform(0, 2 * n, 2 * n));
  const auto levels = energy_levels(spline_levels(large, 1));
  const VectorXd p = random_numbers(levels.levels[0].E.rows(), 3);
  const auto& E = levels.levels[1].E;
  const VectorXd exact = VariationalScheme(levels, 0).apply(p);
  double before = 0;
  for (int cells : {4, 8, 16}) {
    small.x = small.y.emplace(Breakpoints::uniform(0, 2 * cells, 2 * cells));
    const VectorXd error = PaddedScheme(small).apply(p, {n, n}) - exact;
    const double size = std::sqrt(error.dot(E * error) / exact.dot(E * exact));
    report.row({name, cells, (cells + degree) * (cells + degree), size, before == 0 ? Cell("") : Cell(before / size)});
    before = size;
  }
}

void measure_prediction(Report& report, const Problem& problem) {
  const auto levels = spline_levels(problem.domain, 3);
  const VectorXd q0 = random_numbers(levels[0].size(), 1);
  const auto exact = Predictor(levels, {.kind = problem.kind, .layers = 0}).run(q0).energies;
  const auto add = [&](const std::string& rules, const std::vector<double>& energies) {
    std::vector<Cell> row = {problem.name, rules};
    for (std::size_t k = 0; k < energies.size(); ++k) row.emplace_back(energies[k] / exact.back());
    report.row(row);
  };
  add("exact", exact);
  for (int layers : {1, 2, 4})
    for (bool smoothing : {false, true})
      add(std::to_string(layers) + (layers == 1 ? " layer" : " layers") + (smoothing ? ", smoothed" : ""),
          Predictor(levels, {.kind = problem.kind, .layers = layers, .smoothing = smoothing}).run(q0).energies);
}

/// A forward and a backward Gauss-Seidel sweep for E p = f.
void sweep(const Eigen::SparseMatrix<double>& E, const VectorXd& f, VectorXd& p) {
  const auto improve = [&](Eigen::Index i) {
    double rest = f[i];
    for (Eigen::SparseMatrix<double>::InnerIterator e(E, i); e; ++e) rest -= e.value() * p[e.row()];
    p[i] += rest / E.coeff(i, i);
  };
  for (Eigen::Index i = 0; i < p.size(); ++i) improve(i);
  for (Eigen::Index i = p.size(); i-- > 0;) improve(i);
}

/// Energies of p_k = S_{k-1} p_{k-1} over those of the exact p_3, exact and padded.
void measure_bell_energies(Report& report, const std::string& name, const VariationalDomain& domain) {
  const auto levels = energy_levels(spline_levels(domain, 3));
  const VectorXd p0 = random_numbers(levels.levels[0].E.rows(), 1);
  const auto energies = [&](auto&& step, bool smoothing) {
    VectorXd p = p0, f = levels.levels[0].E * p0;
    std::vector<double> result = {p.dot(f)};
    for (int k = 0; k < 3; ++k) {
      p = step(k, p);
      f = (levels.steps[static_cast<std::size_t>(k)].M.transpose() * f).eval();
      const auto& E = levels.levels[static_cast<std::size_t>(k + 1)].E;
      if (smoothing) sweep(E, f, p);
      result.push_back(p.dot(E * p));
    }
    return result;
  };
  const auto exact = energies([&](int k, const VectorXd& p) { return VariationalScheme(levels, k).apply(p); }, false);
  const auto add = [&](const std::string& rules, const std::vector<double>& found) {
    std::vector<Cell> row = {name, rules};
    for (double e : found) row.emplace_back(e / exact.back());
    report.row(row);
  };
  add("exact", exact);
  for (int cells : {4, 8}) {
    auto small = domain;
    small.x = small.y.emplace(Breakpoints::uniform(0, 2 * cells, 2 * cells));
    const PaddedScheme padded(small);
    const int coarsest = domain.x.cells() / 8;
    for (bool smoothing : {false, true})
      add("padded, " + std::to_string(cells) + (smoothing ? " cells, smoothed" : " cells"),
          energies(
              [&](int k, const VectorXd& p) {
                return padded.apply(p, {coarsest << k, coarsest << k});
              },
              smoothing));
  }
}

/// Relative error in the energy norm of the best approximation of the solution of E u = f from the columns of B.
double approximation_error(const Eigen::SparseMatrix<double>& E, const Eigen::MatrixXd& B, const VectorXd& u) {
  const VectorXd f = E * u;
  const VectorXd c =
      Eigen::MatrixXd(B.transpose() * (E * B)).completeOrthogonalDecomposition().solve(B.transpose() * f);
  const VectorXd error = u - B * c;
  return std::sqrt(std::abs(error.dot(E * error) / u.dot(f)));
}

/// Spaces of one coarse level for the membrane: refined coarse hats, the bell form with sampled values, the
/// interpolating form with cell averages. The latter two are different spaces.
void measure_spaces(Report& report, const std::string& name, const VariationalDomain& domain) {
  const auto levels = spline_levels(domain, 1);
  const auto bell = energy_levels(levels);
  const auto& E = bell.levels[1].E;
  const auto M = measurement_matrix(levels[0], levels[1], Measurement::CellAverages).M;
  // A smooth load of mean zero: averages of a wave, against hats.
  const int side = levels[1].x().size();
  VectorXd load(E.rows());
  for (Eigen::Index g = 0; g < load.size(); ++g)
    load[g] = std::cos(M_PI * static_cast<double>(g % side) / (side - 1)) *
              std::cos(2 * M_PI * static_cast<double>(g / side) / (side - 1));
  load.array() -= load.mean();
  const auto pinned = lower_submatrix(E, [&] {
    std::vector<int> kept(static_cast<std::size_t>(E.rows() - 1));
    for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = static_cast<int>(i) + 1;
    return kept;
  }());
  VectorXd u = load;
  u[0] = 0;
  SparseCholesky(pinned).solve({u.data() + 1, static_cast<std::size_t>(u.size() - 1)});
  const auto add = [&](const std::string& space, const Eigen::MatrixXd& B) {
    report.row({name, space, static_cast<double>(B.cols()), approximation_error(E, B, u)});
  };
  add("refined hats", bell.steps[0].R);
  add("bell form, exact", VariationalScheme(bell, 0).matrix());
  add("interpolating, exact", LeastEnergy(E, M).matrix());
  for (int layers : {1, 2, 3, 4})
    add("interpolating, " + std::to_string(layers) + (layers == 1 ? " layer" : " layers"),
        LocalScheme(levels[0], levels[1], Measurement::CellAverages, layers).matrix());
}

struct Cost {
  double derivation = 0, application = 0;  ///< seconds for each unknown
};

/// A problem whose local rules are timed.
class Timing {
public:
  explicit Timing(const Problem& problem) : problem_(problem), levels_(spline_levels(problem.domain, 1)) {}

  /// Once more; the least counts.
  void measure() {
    least_.derivation =
        std::min(least_.derivation, seconds_of([&] { local_.emplace(levels_[0], levels_[1], problem_.kind, 4); }));
    const VectorXd m = random_numbers(local_->columns(), 1);
    VectorXd q;
    least_.application = std::min(least_.application, least_seconds(40, [&] { q = local_->apply(m); }));
  }
  Cost cost(Report& report) const {
    const double unknowns = local_->rows();
    const Cost each = {least_.derivation / unknowns, least_.application / unknowns};
    report.row({problem_.name, unknowns, local_->rules(), static_cast<double>(local_->stored_weights()) / unknowns,
                each.derivation, each.application});
    return each;
  }

private:
  Problem problem_;
  std::vector<SplineLevel> levels_;
  std::optional<LocalScheme> local_;
  Cost least_ = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
};

/// Two sizes, the second four times the first, in turns: other work on the machine meets both.
void measure_growth(Report& report, const std::string& name, const Problem& small, const Problem& large) {
  Timing a(small), b(large);
  for (int turn = 0; turn < 2; ++turn) {
    a.measure();
    b.measure();
  }
  const Cost first = a.cost(report), second = b.cost(report);
  report.at_most("time per unknown to derive, large over small, " + name, 1.5, second.derivation / first.derivation);
  report.at_most("time per unknown to apply, large over small, " + name, 2, second.application / first.application);
}

void measure_tables(Report& report) {
  const auto membrane = Energy::membrane(), plate = Energy::thin_plate();
  const auto averages = Measurement::CellAverages, centres = Measurement::CentreValues;
  const std::vector<Problem> problems = {
      {"membrane", grid(membrane, 1, 64), averages},
      {"membrane, contrast 1000", with_contrast(grid(membrane, 1, 64)), averages},
      {"membrane, checkerboard 1000", with_checkerboard(grid(membrane, 1, 64)), averages},
      {"membrane, mask", with_mask(grid(membrane, 1, 64)), averages},
      {"thin plate, degree 2", grid(plate, 2, 64), centres},
      {"thin plate, degree 2, contrast 1000", with_contrast(grid(plate, 2, 64)), centres},
      {"thin plate, degree 3", grid(plate, 3, 64), centres},
      {"bending of an uneven line, degree 3", uneven_line(1000), centres}};
  report.table(
      "interpolating form, 64 x 64 cells: error in the energy norm for measurements of random coarse functions",
      {"problem", "layers", "rules", "error", "fall", "energy - 1"});
  for (const Problem& problem : problems) measure_layers(report, problem);
  report.table("bell form, padded rules on 64 x 64 cells: error in the energy norm for random coarse coefficients",
               {"problem", "cells", "weights", "error", "fall"});
  auto hats = grid(membrane, 1, 8);
  hats.triangles = true;
  measure_padding(report, "membrane, the source's hats", hats, 1);
  measure_padding(report, "membrane, products of hats", grid(membrane, 1, 8), 1);
  measure_padding(report, "thin plate, degree 2", grid(plate, 2, 8), 2);
  measure_padding(report, "thin plate, degree 3", grid(plate, 3, 8), 3);
  report.table("approximation of the solution for a smooth load from one coarse level, 32 x 32 cells, energy norm",
               {"problem", "space", "functions", "error"});
  measure_spaces(report, "membrane", grid(membrane, 1, 32));
  measure_spaces(report, "membrane, contrast 1000", with_contrast(grid(membrane, 1, 32)));
  measure_spaces(report, "membrane, checkerboard 1000", with_checkerboard(grid(membrane, 1, 32)));
  report.table("energies of the predictor's levels over the exact one of the finest, three steps to 64 x 64 cells",
               {"problem", "rules", "level 0", "level 1", "level 2", "level 3"});
  for (const Problem& problem : problems) measure_prediction(report, problem);
  report.table("energies of the bell form's p_k over the exact one of level 3, three steps to 64 x 64 cells",
               {"problem", "rules", "level 0", "level 1", "level 2", "level 3"});
  auto finer_hats = grid(membrane, 1, 64);
  finer_hats.triangles = true;
  measure_bell_energies(report, "membrane, the source's hats", finer_hats);
  measure_bell_energies(report, "thin plate, degree 2", grid(plate, 2, 64));
  measure_bell_energies(report, "thin plate, degree 3", grid(plate, 3, 64));
}

void measure(Report& report) {
  report.note("threads", omp_get_max_threads());
  measure_tables(report);
  const auto membrane = Energy::membrane();
  const auto averages = Measurement::CellAverages, centres = Measurement::CentreValues;
  report.table("local rules of four layers: seconds for each unknown",
               {"problem", "unknowns", "rules", "weights / unknown", "to derive", "to apply"});
  measure_growth(report, "uneven line", {"uneven line, 25 000 knots", uneven_line(24'999), centres},
                 {"uneven line, 100 000 knots", uneven_line(99'999), centres});
  measure_growth(report, "mask", {"mask, 257^2", with_mask(grid(membrane, 1, 256)), averages},
                 {"mask, 513^2", with_mask(grid(membrane, 1, 512)), averages});
  measure_growth(report, "contrast 1000", {"contrast 1000, 257^2", with_contrast(grid(membrane, 1, 256)), averages},
                 {"contrast 1000, 513^2", with_contrast(grid(membrane, 1, 512)), averages});
  measure_growth(report, "uniform", {"uniform, 513^2", grid(membrane, 1, 512), averages},
                 {"uniform, 1025^2", grid(membrane, 1, 1024), averages});
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run_benchmark(argc, argv, "variational", batten::measure); }
