// SPDX-License-Identifier: MIT
// What the ways of choosing the smoothing cost, in V-cycles: none (as close to interpolation as the grid allows), a
// tolerance, and cross-validation, on measured data and on random points.
#include <batten/bench/support/places.h>
#include <batten/bench/support/report.h>
#include <batten/bench/support/test_surface.h>
#include <batten/domains/grid_choice.h>
#include <batten/fem/fit.h>
#include <batten/io/table.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace batten {
namespace {

struct DataSet {
  std::string name;
  Observations observations;
  Rectangle region;
  double aspect = 1;

  double range() const {
    const auto [low, high] = std::minmax_element(observations.value.begin(), observations.value.end());
    return *high - *low;
  }
};

DataSet read_example(const std::string& name, const std::vector<std::string>& columns, bool geographic) {
  Table table = read_table(example_data() / (name + ".csv"), {.columns = columns});
  Observations o{table.columns[0], table.columns[1], table.columns[2], {}};
  const auto [south, north] = std::minmax_element(o.y.begin(), o.y.end());
  const double aspect = geographic ? 1 / std::cos((*south + *north) / 2 * std::numbers::pi / 180) : 1;
  const Rectangle region = choose_grid(o.x, o.y, {.aspect = aspect});
  return {name, std::move(o), region, aspect};
}

/// Franke's function at random points, with normally distributed noise.
DataSet noisy(std::size_t points, int cells, double deviation) {
  DataSet set{std::to_string(points) + " random, noise " + Cell(deviation).text, random_observations(points),
              unit_square(cells, cells)};
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal(0, 1);
  for (double& value : set.observations.value) value += deviation * normal(random);
  return set;
}

std::string cells_of(const DataSet& set) {
  return std::to_string(set.region.x.cells()) + "x" + std::to_string(set.region.y.cells());
}

/// Least distance of two points that are not at the same place, in cells.
double least_distance(const DataSet& set) {
  const auto& o = set.observations;
  std::vector<std::array<double, 2>> p;
  for (std::size_t i = 0; i < o.size(); ++i)
    p.push_back({set.region.x.to_cells(o.x[i]), set.region.y.to_cells(o.y[i])});
  std::sort(p.begin(), p.end());
  double least = INFINITY;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 1; j < p.size() && p[j][0] - p[i][0] < least; ++j)
      if (p[i] != p[j]) least = std::min(least, std::hypot(p[j][0] - p[i][0], p[j][1] - p[i][1]));
  return least;
}

FitResult fit(const DataSet& set, Smoothing smoothing) {
  return fit_surface(set.observations, set.region, {.smoothing = smoothing, .aspect = set.aspect});
}

void interpolate(Report& report, const std::vector<DataSet>& sets) {
  report.table("--smoothing none, thin plate, degree 3",
               {"data", "points", "cells", "closest, cells", "merged", "V-cycles", "residual / range"});
  for (const auto& set : sets) {
    const auto result = fit(set, Smoothing::none());
    const double distance = least_distance(set);
    // coincident points are averaged: what they differ by is no failure of the interpolation
    double residual = result.largest_residual / set.range();
    report.row({set.name, set.observations.size(), cells_of(set), distance, result.points_merged, result.iterations,
                residual});
    report.at_most("V-cycles of --smoothing none, " + set.name, 200, result.iterations);
    if (result.points_merged == 0)
      report.at_most("its residual / range, closest points " + Cell(distance).text + " cells apart",
                     distance >= 1 ? 1e-9 : 1e-6, residual);
  }
}

void stay_within_tolerance(Report& report, const std::vector<DataSet>& sets) {
  report.table("--tolerance E, thin plate, degree 3", {"data", "E / range", "V-cycles", "residual / E", "reached"});
  for (const auto& set : sets)
    for (double share : {1e-2, 1e-3}) {
      const double tolerance = share * set.range();
      try {
        const auto result = fit(set, Smoothing::within(tolerance));
        report.row({set.name, share, result.iterations, result.largest_residual / tolerance,
                    result.tolerance_reached ? "yes" : "no"});
      } catch (const std::exception& error) {
        report.row({set.name, share, "", "", error.what()});
      }
    }
}

void cross_validate(Report& report, const std::vector<DataSet>& sets) {
  report.table("--smoothing auto, thin plate, degree 3",
               {"data", "cells", "lambda", "degrees of freedom", "search, V-cycles", "of these refinement",
                "solve, V-cycles", "refinement / solve"});
  for (const auto& set : sets) {
    const auto result = fit(set, Smoothing::automatic());
    const double ratio = static_cast<double>(result.refinement_iterations) / result.iterations;
    report.row({set.name, cells_of(set), result.lambda, result.effective_degrees.value_or(NAN),
                result.search_iterations, result.refinement_iterations, result.iterations, ratio});
    report.at_most("refinement of lambda over the final solve, in V-cycles, " + set.name, 5, ratio);
  }
}

void measure(Report& report) {
  const std::vector<DataSet> sets = {read_example("volcano", {"x", "y", "z"}, false),
                                     read_example("rmprecip", {"lon", "lat", "precipitation"}, true),
                                     {"2000 random", random_observations(2000), unit_square(256, 256)}};
  interpolate(report, sets);
  stay_within_tolerance(report, sets);
  std::vector<DataSet> smoothed(sets.begin(), sets.end() - 1);
  smoothed.push_back(noisy(2'000, 256, 0.05));
  smoothed.push_back(noisy(20'000, 512, 0.05));
  smoothed.push_back(noisy(200'000, 1024, 0.05));
  smoothed.push_back({"20000 random, exact", random_observations(20'000), unit_square(512, 512)});
  cross_validate(report, smoothed);
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run_benchmark(argc, argv, "interpolation", batten::measure); }
