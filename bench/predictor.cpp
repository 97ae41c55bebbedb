// SPDX-License-Identifier: MIT
// What variational schemes are worth as predictors: as the start of the solver of `batten fit`, against refinement and
// the full multigrid start that it has; and for the thin plate through values on a coarse grid, refined to 1025²
// points, against the solver of `batten fit` and CHOLMOD on the same problem.
#include <batten/bench/support/report.h>
#include <batten/bench/support/test_surface.h>
#include <batten/bench/support/timing.h>
#include <batten/fem/energy_levels.h>
#include <batten/fem/fit_problem.h>
#include <batten/fem/predictor.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace batten {
namespace {

constexpr int layers = 4;

VariationalDomain plate(int cells, int degree) {
  VariationalDomain domain{Breakpoints::uniform(0, 1, cells)};
  domain.y = domain.x;
  domain.energy = Energy::thin_plate();
  domain.degree = degree;
  return domain;
}

// ---- the start of a fit

struct Trial {
  PreparedData prepared;
  FitProblem problem;
  std::vector<double> b;

  Trial(const Observations& o, int cells, double lambda)
      : prepared(prepare(o, unit_square(cells, cells), Energy::thin_plate(), false)),
        problem(prepared.data, unit_square(cells, cells), FitOptions{}) {
    problem.system().set(lambda, problem.weight());
    b = problem.right_side(problem.weight(), problem.value());
  }
  /// V-cycles from the start c to 1e-10 of the solution's size.
  int iterations(std::vector<double> c, double scale) {
    return solve(problem.system(), b, c, {.accuracy = 1e-10, .most_iterations = 500}, scale).iterations;
  }
};

void compare_starts(Report& report) {
  report.table("V-cycles of a fit to 1e-10 from the solution on half the cells, thin plate, degree 3",
               {"points", "cells", "lambda", "from 0, full multigrid", "refined by R", "predicted",
                "V-cycles of the prediction"});
  for (const std::size_t points : {2'000, 20'000})
    for (int cells : {256, 512})
      for (double lambda : {1e-6, 1e-10}) {
        const auto observations = random_observations(points);
        Trial coarse(observations, cells / 2, lambda), fine(observations, cells, lambda);
        std::vector<double> half(coarse.b.size()), zero(fine.b.size()), refined(fine.b.size());
        solve(coarse.problem.system(), coarse.b, half);
        const double scale = energy_size(fine.problem.system(), fine.b);
        fine.problem.hierarchy()[0].refinement->apply(half, refined);
        const auto levels = spline_levels(plate(cells, 3), 1);
        const Predictor predictor(levels, {.kind = Measurement::CentreValues, .layers = layers});
        const Eigen::Map<const Eigen::VectorXd> q(half.data(), static_cast<Eigen::Index>(half.size()));
        Eigen::VectorXd p;
        const double seconds = least_seconds(3, [&] { p = predictor.predict(0, q); });
        std::vector<double> cycle;
        const double cycle_seconds = least_seconds(3, [&] { fine.problem.system().precondition(fine.b, cycle); });
        report.row({points, std::to_string(cells) + "^2", lambda, fine.iterations(zero, scale),
                    fine.iterations(refined, scale), fine.iterations({p.begin(), p.end()}, scale),
                    seconds / cycle_seconds});
      }
}

// ---- values on a coarse grid

constexpr int coarse_cells = 64;

/// Values of Franke's function at the middles of the coarse cells.
Observations middles() {
  Observations o;
  for (int j = 0; j < coarse_cells; ++j)
    for (int i = 0; i < coarse_cells; ++i) {
      o.x.push_back((i + 0.5) / coarse_cells);
      o.y.push_back((j + 0.5) / coarse_cells);
      o.value.push_back(franke(o.x.back(), o.y.back()));
    }
  return o;
}

Eigen::VectorXd predicted(const std::vector<SplineLevel>& levels, const Eigen::VectorXd& m) {
  Eigen::VectorXd q = LocalScheme(levels[0], levels[1], Measurement::CentreValues, layers).apply(m);
  if (levels.size() == 2) return q;
  const Predictor predictor({levels.begin() + 1, levels.end()}, {.kind = Measurement::CentreValues, .layers = layers});
  for (int k = 0; k < predictor.steps(); ++k) q = predictor.predict(k, q);
  return q;
}

/// Values at the middles of the coarse cells, which are corners of fine ones, in the finest basis.
MeasurementMatrix::Matrix values_at_middles(const SplineLevel& fine) {
  const int factor = fine.x().cells() / coarse_cells, degree = fine.x().degree();
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < coarse_cells; ++j)
    for (int i = 0; i < coarse_cells; ++i) {
      const int cx = factor * i + factor / 2, cy = factor * j + factor / 2;
      const auto x = fine.x().at(cx, 0), y = fine.y().at(cy, 0);
      for (int b = 0; b <= degree; ++b)
        for (int a = 0; a <= degree; ++a)
          if (x[a] * y[b] != 0) entries.emplace_back(i + coarse_cells * j, fine.function(cx + a, cy + b), x[a] * y[b]);
    }
  MeasurementMatrix::Matrix M(coarse_cells * coarse_cells, fine.size());
  M.setFromTriplets(entries.begin(), entries.end());
  return M;
}

void interpolate_grid(Report& report) {
  report.table("thin plate, degree 2, through 64 x 64 values: seconds, and energy over the least one, minus 1",
               {"cells", "predicted, 4 layers", "ns / unknown", "batten fit, none", "CHOLMOD",
                "excess of the predicted", "excess of the fit"});
  const Observations o = middles();
  const Eigen::Map<const Eigen::VectorXd> m(o.value.data(), static_cast<Eigen::Index>(o.value.size()));
  std::vector<double> per_unknown;
  for (int steps : {2, 3, 4}) {
    const int cells = coarse_cells << steps;
    const auto levels = spline_levels(plate(cells, 2), steps);
    const SplineLevel& fine = levels.back();
    Eigen::VectorXd q;
    const double prediction = least_seconds(2, [&] { q = predicted(levels, m); });
    std::optional<FitResult> fit;
    const double fitting = seconds_of(
        [&] { fit.emplace(fit_surface(o, unit_square(cells, cells), {.degree = 2, .smoothing = Smoothing::none()})); });
    const auto c = fit->solution.coefficients();
    const double of_fit =
        fine.energy_of(Eigen::Map<const Eigen::VectorXd>(c.data(), static_cast<Eigen::Index>(c.size())));
    double direct = NAN, least = of_fit;
    if (cells <= 512) {
      Eigen::VectorXd exact;
      direct = seconds_of([&] { exact = LeastEnergy(fine.energy(), values_at_middles(fine)).apply(m); });
      least = fine.energy_of(exact);
    }
    per_unknown.push_back(1e9 * prediction / fine.size());
    report.row({std::to_string(cells) + "^2", prediction, per_unknown.back(), fitting, direct,
                fine.energy_of(q) / least - 1, of_fit / least - 1});
  }
  report.at_most("time per unknown of the prediction, 1024^2 over 256^2", 1.5,
                 per_unknown.back() / per_unknown.front());
}

void measure(Report& report) {
  compare_starts(report);
  interpolate_grid(report);
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run_benchmark(argc, argv, "predictor", batten::measure); }
