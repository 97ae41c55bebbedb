// SPDX-License-Identifier: MIT
// Speed of curves through and near 10^6 points at knots that are not uniform, against what memory allows: knots and
// points read and coefficients written once, at the triad's bandwidth, measured in the same run. The knots are handed
// over to the curve, not copied; checks and a second pass over the points count against us. Then the number of banded
// factorisations within tolerances, and their time in the same unit.
#include <batten/bench/support/report.h>
#include <batten/bench/support/timing.h>
#include <batten/bench/support/triad.h>
#include <batten/fem/curve_fit.h>
#include <batten/fem/curve_within.h>

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace batten {
namespace {

struct Input {
  Input(int n, int dimension) : knots(static_cast<std::size_t>(n)), points(n, dimension) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    double t = 0;
    for (double& knot : knots) knot = t += 0.5 + unit(random);
    for (int c = 0; c < dimension; ++c)
      for (int i = 0; i < n; ++i) points(i, c) = std::sin(0.001 * i + c) + 0.1 * unit(random);
  }
  double bytes() const { return 8. * static_cast<double>(knots.size()) * static_cast<double>(1 + 2 * points.cols()); }

  std::vector<double> knots;
  Eigen::MatrixXd points;
};

/// Nanoseconds for each point.
double cost(const Input& input, double lambda) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 15; ++k) {
    std::vector<double> knots = input.knots;
    least = std::min(least, seconds_of([&] { smoothing_curve(std::move(knots), input.points, {}, lambda); }));
  }
  return 1e9 * least / static_cast<double>(input.knots.size());
}

void measure_dimension(Report& report, Triad& triad, int dimension) {
  const int n = 1'000'000;
  const Input small(n / 10, dimension), large(n, dimension);
  const std::string components = dimension == 1 ? "1 component" : std::to_string(dimension) + " components";
  report.table("curves of 10^6 points, " + components,
               {"curve", "ns / point", "time / bound", "per point / that of 10^5"});
  const struct {
    const char* name;
    double length;  // over which λ smooths, in points; 0 interpolates
  } cases[] = {{"interpolating", 0}, {"smoothing over 3 points", 3}, {"smoothing over 10^5 points", 1e5}};
  for (const auto& c : cases) {
    const double lambda = std::pow(c.length, 4), bound = 1e9 * large.bytes() / n / triad.bytes_per_second();
    const double time = cost(large, lambda), growth = time / cost(small, lambda);
    report.row({c.name, time, time / bound, growth});
    report.at_most(std::string(c.name) + ", " + components + ", time / bound", 5, time / bound);
    report.at_most(std::string(c.name) + ", " + components + ", cost per point, 10^6 / 10^5", 1.5, growth);
  }
}

/// Points within tolerances of a few deviations of their noise, which is uniform: from 1 on hardly any force is left.
void measure_tolerances(Report& report, Triad& triad, int dimension) {
  const std::string components = dimension == 1 ? "1 component" : std::to_string(dimension) + " components";
  report.table("curves within tolerances, " + components,
               {"points", "tolerance / deviation", "factorisations", "ns / point", "time / bound", "gap"});
  for (const double deviations : {0.5, 1.5, 3.}) {
    double first = 0;  // time of a factorisation for each point
    for (const int n : {1000, 10'000, 100'000, 1'000'000}) {
      const Input input(n, dimension);
      const std::vector<double> tolerances(static_cast<std::size_t>(n), 0.1 / std::sqrt(12.) * deviations);
      CurveAccount account;
      const double time =
          1e9 / n * seconds_of([&] { account = least_curve_within(input.knots, input.points, tolerances).account; });
      const double bound = 1e9 * input.bytes() / n / triad.bytes_per_second(), each = time / account.factorisations;
      report.row({std::to_string(n), deviations, account.factorisations, time, time / bound, account.energy_gap});
      report.at_most("factorisations, " + std::to_string(n) + " points", 60, account.factorisations);
      if (n == 10'000) first = each;
      if (n > 10'000)
        report.at_most("cost per point and factorisation, " + std::to_string(n) + " / 10^4", 1.5, each / first);
    }
  }
}

void measure(Report& report) {
  // Memory that is freed is kept: the first touch of new pages is not of interest.
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  Triad triad;
  report.note("triad, GB / s", triad.bytes_per_second() / 1e9);
  for (int dimension : {1, 2}) measure_dimension(report, triad, dimension);
  for (int dimension : {1, 2}) measure_tolerances(report, triad, dimension);
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run_benchmark(argc, argv, "curves", batten::measure); }
