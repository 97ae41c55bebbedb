// SPDX-License-Identifier: MIT
// A fit of 10^6 vectors on 1024 x 1024 cells for a given λ against that of 2 · 10^6 values, as many rows, by a thin
// plate: time for each unknown.
#include <batten/bench/support/report.h>
#include <batten/bench/support/timing.h>
#include <batten/flows/flow_fit.h>

#include <cmath>
#include <numbers>
#include <random>

namespace batten {
namespace {

constexpr int cells = 1024, degree = 3, vectors = 1'000'000;
const Rectangle square{Interval(0, 1, cells), Interval(0, 1, cells)};

/// Taylor-Green flow with noise at random places.
VectorObservations noisy_vectors() {
  constexpr double pi = std::numbers::pi;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(0, 1);
  std::normal_distribution<double> error(0, 0.1);
  VectorObservations o;
  for (int i = 0; i < vectors; ++i) {
    const double x = place(random), y = place(random);
    o.x.push_back(x);
    o.y.push_back(y);
    o.u.push_back(std::sin(pi * x) * std::cos(pi * y) + error(random));
    o.v.push_back(-std::cos(pi * x) * std::sin(pi * y) + error(random));
  }
  return o;
}

/// Both components as values, those of v at places of their own.
Observations as_values(const VectorObservations& o) {
  Observations result{o.x, o.y, o.u, {}, {}};
  result.x.insert(result.x.end(), o.y.begin(), o.y.end());
  result.y.insert(result.y.end(), o.x.begin(), o.x.end());
  result.value.insert(result.value.end(), o.v.begin(), o.v.end());
  return result;
}

void measure(Report& report) {
  constexpr double unknowns = static_cast<double>(cells + degree) * (cells + degree);
  const auto o = noisy_vectors();
  const auto values = as_values(o);
  report.table("10^6 vectors and 2 · 10^6 values on 1024 x 1024 cells, degree 3",
               {"lambda", "fit", "iterations", "seconds", "ns / unknown"});
  for (const double lambda : {1e-6, 1e-9}) {
    int iterations = 0;
    const auto row = [&](const char* name, double seconds, double parts) {
      report.row({lambda, name, iterations, seconds, 1e9 * seconds / (parts * unknowns)});
      return seconds / (parts * unknowns);
    };
    const auto smoothing = Smoothing::fixed(lambda);
    const auto flow = [&](FlowModel model) {
      return least_seconds(
          2, [&] { iterations = fit_flow(o, square, {.model = model, .smoothing = smoothing}).iterations; });
    };
    const double surface = least_seconds(
        2, [&] { iterations = fit_surface(values, square, {.degree = degree, .smoothing = smoothing}).iterations; });
    const double of_surface = row("thin plate", surface, 1);
    const double of_smooth = row("smooth", flow(FlowModel::Smooth), 1);
    const double of_general = row("general", flow(FlowModel::General), 2);
    const std::string at = ", lambda " + std::string(lambda == 1e-6 ? "1e-6" : "1e-9");
    report.at_most("time per unknown, smooth over thin plate" + at, 2.5, of_smooth / of_surface);
    report.at_most("time per unknown, general over thin plate" + at, 2.5, of_general / of_surface);
  }
}

}  // namespace
}  // namespace batten

int main(int argc, char** argv) { return batten::run_benchmark(argc, argv, "flows", batten::measure); }
